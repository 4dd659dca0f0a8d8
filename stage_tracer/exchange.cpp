#include "stage_tracer/exchange.hpp"

#include <algorithm>
#include <cmath>

#include "physics/closures/biot.hpp"
#include "physics/closures/convection.hpp"
#include "physics/closures/solid_enthalpy.hpp"

namespace cupola {

std::vector<double> volumetric_heat_capacity(const Species& species, const std::vector<double>& temperature) {
  std::vector<double> capacity(temperature.size());
  for (std::size_t c = 0; c < capacity.size(); ++c)
    capacity[c] = species.density * apparent_heat_capacity(species, temperature[c]);
  return capacity;
}

Exchange::Exchange(const Campaign& campaign, const CellSpreading& kernel)
    : campaign_(campaign), kernel_(kernel), gas_(campaign.scene.gas.value_or(Gas{})) {}

double Exchange::mean_decay(double x) { return x > 0 ? -std::expm1(-x) / x : 1.0; }

void Exchange::set_rates(const GasFields& gas, const CellContents& contents) {
  const Heat& heat = *campaign_.heat;
  const std::size_t cells = gas.mass_flux.size();
  coefficient_.assign(campaign_.species.size(), std::vector<double>(cells));
  largest_biot_.assign(campaign_.species.size(), 0.0);
  std::vector<GasAround> around(cells);
  for (std::size_t c = 0; c < cells; ++c) {
    const Vector3& flux = gas.mass_flux[c];
    around[c] = {std::hypot(flux[0], flux[1], flux[2]), gas_.viscosity(gas.temperature[c]),
                 campaign_.scene.gas->prandtl, gas_.conductivity(gas.temperature[c]), gas.void_fraction[c]};
  }
  for (std::size_t s = 0; s < campaign_.species.size(); ++s) {
    const Species& species = campaign_.species[s];
    for (std::size_t c = 0; c < cells; ++c) {
      double& transfer = coefficient_[s][c];
      transfer = heat_transfer_coefficient(heat, around[c], species.diameter);
      // Tracers of neighbouring cells feel this cell's gas too; the grains' own conductivity is that of the cell's
      // solids, or of solids as hot as its gas.
      const bool present = contents.volume[s][c] > 0;
      const double conductivity = species.conductivity.at(present ? contents.temperature[s][c] : gas.temperature[c]);
      if (present) largest_biot_[s] = std::max(largest_biot_[s], biot_number(transfer, species.diameter, conductivity));
      if (heat.intragrain_resistance)
        transfer = transfer_with_intragrain_resistance(transfer, species.diameter, conductivity);
    }
  }
  felt_ = coefficient_;
  kernel_.gather(pointers(felt_));
  rate_ = felt_;
  for (std::size_t s = 0; s < campaign_.species.size(); ++s) {
    const Species& species = campaign_.species[s];
    const std::vector<double> capacity = volumetric_heat_capacity(species, contents.temperature[s]);
    for (std::size_t c = 0; c < cells; ++c) rate_[s][c] *= 6 / (species.diameter * capacity[c]);
  }
}

SolidsExchange Exchange::solids(const CellContents& contents, double step) const {
  BySpecies conductance = felt_;
  BySpecies conductance_temperature = felt_;
  for (std::size_t s = 0; s < felt_.size(); ++s) {
    for (std::size_t c = 0; c < felt_[s].size(); ++c) {
      conductance[s][c] *= mean_decay(rate_[s][c] * step) * 6 * contents.volume[s][c] / campaign_.species[s].diameter;
      conductance_temperature[s][c] = conductance[s][c] * contents.temperature[s][c];
    }
  }
  return seen_by_gas(std::move(conductance), std::move(conductance_temperature));
}

SolidsExchange Exchange::seen_by_gas(BySpecies conductance, BySpecies conductance_temperature) const {
  const std::size_t cells = felt_.front().size();
  SolidsExchange result{std::vector<double>(cells, 0.0), std::vector<double>(cells, 0.0)};
  for (std::size_t s = 0; s < felt_.size(); ++s) {
    for (std::size_t c = 0; c < cells; ++c) {
      const double inverse = felt_[s][c] > 0 ? 1 / felt_[s][c] : 0;
      conductance[s][c] *= inverse;
      conductance_temperature[s][c] *= inverse;
    }
  }
  std::vector<std::vector<double>*> sums = pointers(conductance);
  for (auto& values : conductance_temperature) sums.push_back(&values);
  kernel_.apply(sums);
  for (std::size_t s = 0; s < felt_.size(); ++s) {
    for (std::size_t c = 0; c < cells; ++c) {
      result.conductance[c] += coefficient_[s][c] * conductance[s][c];
      result.conductance_temperature[c] += coefficient_[s][c] * conductance_temperature[s][c];
    }
  }
  return result;
}

BySpecies Exchange::felt_temperature(const std::vector<double>& gas_temperature) const {
  BySpecies result = coefficient_;
  for (auto& values : result) {
    for (std::size_t c = 0; c < values.size(); ++c) values[c] *= gas_temperature[c];
  }
  kernel_.gather(pointers(result));
  for (std::size_t s = 0; s < result.size(); ++s) {
    for (std::size_t c = 0; c < result[s].size(); ++c)
      result[s][c] = felt_[s][c] > 0 ? result[s][c] / felt_[s][c] : gas_temperature[c];
  }
  return result;
}

}  // namespace cupola
