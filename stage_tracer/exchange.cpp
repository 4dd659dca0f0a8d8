#include "stage_tracer/exchange.hpp"

#include <cmath>

#include "physics/closures/gas_properties.hpp"
#include "physics/closures/ranz_marshall.hpp"
#include "physics/closures/solid_enthalpy.hpp"

namespace cupola {

double Exchange::mean_decay(double x) { return x > 0 ? -std::expm1(-x) / x : 1.0; }

void Exchange::set_rates(const std::vector<Vector3>& mass_flux, double step) {
  const Gas& gas = *campaign_.scene.gas;
  const double conductivity = gas_conductivity(gas.viscosity, gas.heat_capacity, gas.prandtl);
  const std::size_t cells = mass_flux.size();
  coefficient_.assign(campaign_.species.size(), std::vector<double>(cells));
  decay_ = coefficient_;
  mean_decay_ = coefficient_;
  for (std::size_t s = 0; s < campaign_.species.size(); ++s) {
    const Species& species = campaign_.species[s];
    for (std::size_t c = 0; c < cells; ++c) {
      const double flux = std::hypot(mass_flux[c][0], mass_flux[c][1], mass_flux[c][2]);
      coefficient_[s][c] = heat_transfer_coefficient(flux, species.diameter, gas.viscosity, gas.prandtl, conductivity,
                                                     campaign_.heat->nusselt_factor);
    }
    std::vector<double> felt = coefficient_[s];
    kernel_.gather(felt);
    const double factor = 6 / (species.diameter * species.density * species.heat_capacity.at(enthalpy_zero));
    for (std::size_t c = 0; c < cells; ++c) {
      const double x = factor * felt[c] * step;
      decay_[s][c] = std::exp(-x);
      mean_decay_[s][c] = mean_decay(x);
    }
  }
}

SolidsExchange Exchange::solids(const CellContents& contents) const {
  const std::size_t cells = coefficient_.front().size();
  SolidsExchange result{std::vector<double>(cells, 0.0), std::vector<double>(cells, 0.0)};
  for (std::size_t s = 0; s < coefficient_.size(); ++s) {
    std::vector<double> area(cells);
    std::vector<double> area_temperature(cells);
    for (std::size_t c = 0; c < cells; ++c) {
      area[c] = mean_decay_[s][c] * 6 * contents.volume[s][c] / campaign_.species[s].diameter;
      area_temperature[c] = area[c] * contents.temperature[s][c];
    }
    kernel_.apply(area);
    kernel_.apply(area_temperature);
    for (std::size_t c = 0; c < cells; ++c) {
      result.conductance[c] += coefficient_[s][c] * area[c];
      result.conductance_temperature[c] += coefficient_[s][c] * area_temperature[c];
    }
  }
  return result;
}

BySpecies Exchange::felt_temperature(const std::vector<double>& gas_temperature) const {
  BySpecies result;
  for (const std::vector<double>& coefficient : coefficient_)
    result.push_back(kernel_.gather(gas_temperature, coefficient));
  return result;
}

}  // namespace cupola
