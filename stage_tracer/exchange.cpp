#include "stage_tracer/exchange.hpp"

#include <cmath>

#include "physics/closures/gas_properties.hpp"
#include "physics/closures/ranz_marshall.hpp"
#include "physics/closures/solid_enthalpy.hpp"

namespace cupola {

namespace {

std::vector<std::vector<double>*> pointers(BySpecies& arrays) {
  std::vector<std::vector<double>*> result;
  for (auto& array : arrays) result.push_back(&array);
  return result;
}

}  // namespace

double Exchange::mean_decay(double x) { return x > 0 ? -std::expm1(-x) / x : 1.0; }

void Exchange::set_rates(const std::vector<Vector3>& mass_flux, double step) {
  const Gas& gas = *campaign_.scene.gas;
  const double conductivity = gas_conductivity(gas.viscosity, gas.heat_capacity, gas.prandtl);
  const std::size_t cells = mass_flux.size();
  const CellsOfRank& mine = kernel_.share();
  coefficient_.assign(campaign_.species.size(), std::vector<double>(cells));
  for (std::size_t c = mine.begin; c < mine.end; ++c) {
    const double flux = std::hypot(mass_flux[c][0], mass_flux[c][1], mass_flux[c][2]);
    for (std::size_t s = 0; s < campaign_.species.size(); ++s) {
      coefficient_[s][c] = heat_transfer_coefficient(flux, campaign_.species[s].diameter, gas.viscosity, gas.prandtl,
                                                     conductivity, campaign_.heat->nusselt_factor);
    }
  }
  mine.complete(pointers(coefficient_));
  felt_ = coefficient_;
  kernel_.gather(pointers(felt_));
  decay_ = felt_;
  mean_decay_ = felt_;
  for (std::size_t s = 0; s < campaign_.species.size(); ++s) {
    const Species& species = campaign_.species[s];
    const double factor = 6 / (species.diameter * species.density * species.heat_capacity.at(enthalpy_zero));
    for (std::size_t c = mine.begin; c < mine.end; ++c) {
      const double x = factor * felt_[s][c] * step;
      decay_[s][c] = std::exp(-x);
      mean_decay_[s][c] = mean_decay(x);
    }
  }
  mine.complete(pointers(decay_));
  mine.complete(pointers(mean_decay_));
}

SolidsExchange Exchange::solids(const CellContents& contents) const {
  const std::size_t cells = coefficient_.front().size();
  const std::size_t species = coefficient_.size();
  SolidsExchange result{std::vector<double>(cells, 0.0), std::vector<double>(cells, 0.0)};
  BySpecies area(species, std::vector<double>(cells));
  BySpecies area_temperature = area;
  for (std::size_t s = 0; s < species; ++s) {
    for (std::size_t c = 0; c < cells; ++c) {
      area[s][c] = mean_decay_[s][c] * 6 * contents.volume[s][c] / campaign_.species[s].diameter;
      area_temperature[s][c] = area[s][c] * contents.temperature[s][c];
    }
  }
  std::vector<std::vector<double>*> sums = pointers(area);
  for (auto& values : area_temperature) sums.push_back(&values);
  kernel_.apply(sums);
  for (std::size_t s = 0; s < species; ++s) {
    for (std::size_t c = 0; c < cells; ++c) {
      result.conductance[c] += coefficient_[s][c] * area[s][c];
      result.conductance_temperature[c] += coefficient_[s][c] * area_temperature[s][c];
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
