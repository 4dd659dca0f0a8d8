#pragma once
#include "physics/closures/enthalpy_zero.hpp"
#include "physics/closures/gas_properties.hpp"
#include "physics/closures/janaf.hpp"
#include "physics/closures/sutherland.hpp"

namespace cupola {

/// Properties of the campaign's gas over the temperature, by its viscosity and heat capacity models.
class GasState {
 public:
  explicit GasState(const Gas& gas) : gas_(gas), janaf_(gas) {}

  [[nodiscard]] bool constant_heat_capacity() const {
    return gas_.heat_capacity_model == Gas::HeatCapacityModel::constant;
  }
  [[nodiscard]] double viscosity(double temperature) const { return gas_viscosity(gas_, temperature); }  ///< Pa s
  /// At constant pressure, J/kg/K.
  [[nodiscard]] double heat_capacity(double temperature) const {
    return constant_heat_capacity() ? gas_.heat_capacity : janaf_.heat_capacity(temperature);
  }
  /// J/kg from 293 K.
  [[nodiscard]] double enthalpy(double temperature) const {
    return constant_heat_capacity() ? gas_.heat_capacity * (temperature - enthalpy_zero)
                                    : janaf_.enthalpy(temperature) - janaf_.enthalpy(enthalpy_zero);
  }
  /// W/m/K, by the campaign's constant Prandtl number.
  [[nodiscard]] double conductivity(double temperature) const {
    return gas_conductivity(viscosity(temperature), heat_capacity(temperature), gas_.prandtl);
  }

 private:
  Gas gas_;
  Janaf janaf_;
};

}  // namespace cupola
