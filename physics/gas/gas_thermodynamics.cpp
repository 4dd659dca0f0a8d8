#include "physics/gas/gas_thermodynamics.hpp"

#include <algorithm>

#include "janafThermo.H"
#include "perfectGas.H"
#include "physics/closures/enthalpy_zero.hpp"
#include "specie.H"

namespace cupola {
namespace {

constexpr double standard_pressure = 1e5;  // an ideal gas's enthalpy does not depend on it

using FoamThermo = Foam::janafThermo<Foam::perfectGas<Foam::specie>>;

FoamThermo::coeffArray coefficients(const std::array<double, 7>& values) {
  FoamThermo::coeffArray result;
  for (int i = 0; i < 7; ++i) result[i] = values[static_cast<std::size_t>(i)];
  return result;
}

}  // namespace

struct GasThermodynamics::Thermo {
  explicit Thermo(const Gas& gas)
      : foam(Foam::perfectGas<Foam::specie>(Foam::specie("gas", 1, 1000 * gas.molar_mass)), gas.janaf.from,
             gas.janaf.to, gas.janaf.common, coefficients(gas.janaf.high), coefficients(gas.janaf.low), true) {}
  FoamThermo foam;
};

GasThermodynamics::GasThermodynamics(const Gas& gas)
    : constant_heat_capacity_(gas.heat_capacity), from_(gas.janaf.from), to_(gas.janaf.to) {
  if (gas.heat_capacity_model == Gas::HeatCapacityModel::constant) return;
  thermo_ = std::make_unique<Thermo>(gas);
  zero_ = absolute_enthalpy(enthalpy_zero);
}
GasThermodynamics::~GasThermodynamics() = default;

double GasThermodynamics::heat_capacity(double temperature) const {
  if (!thermo_) return constant_heat_capacity_;
  return thermo_->foam.Cp(standard_pressure, std::clamp(temperature, from_, to_));
}

double GasThermodynamics::absolute_enthalpy(double temperature) const {
  const double inside = std::clamp(temperature, from_, to_);
  const double enthalpy = thermo_->foam.Ha(standard_pressure, inside);
  return inside == temperature ? enthalpy : enthalpy + heat_capacity(inside) * (temperature - inside);
}

double GasThermodynamics::enthalpy(double temperature) const {
  if (!thermo_) return constant_heat_capacity_ * (temperature - enthalpy_zero);
  return absolute_enthalpy(temperature) - zero_;
}

}  // namespace cupola
