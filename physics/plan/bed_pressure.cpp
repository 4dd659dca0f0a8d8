#include "physics/plan/bed_pressure.hpp"

#include <algorithm>
#include <cmath>

#include "physics/closures/drag.hpp"
#include "physics/closures/drag_beetstra.hpp"
#include "physics/closures/gas_properties.hpp"
#include "physics/closures/sutherland.hpp"

namespace cupola {
namespace {

constexpr double gravity = 9.81;

struct SolidsAt {
  double resistance = 0;  ///< kg/m3/s
  double weight = 0;      ///< N/m3
};

/// @param shares of the solids volume, summing to 1
SolidsAt solids_at(const Campaign& campaign, double packing, const std::vector<double>& shares, double mass_flux,
                   double viscosity) {
  // The laws see density x speed only through the mass flux.
  const auto resistance = [&](double diameter, double factor) {
    return drag_resistance(campaign.drag, 1 - packing, diameter, viscosity, 1, mass_flux, factor);
  };
  SolidsAt result;
  double surface = 0, mean_diameter = 0;
  for (std::size_t i = 0; i < shares.size(); ++i) {
    const Species& species = campaign.species[i];
    result.weight += packing * shares[i] * species.density * gravity;
    surface += shares[i] / species.diameter;
    mean_diameter += shares[i] * species.diameter;
    if (shares[i] > 0) result.resistance += shares[i] * resistance(species.diameter, 1);
  }
  if (!charged_in_layers(campaign)) {
    const bool beetstra = campaign.drag == DragLaw::beetstra;
    result.resistance = resistance(1 / surface, beetstra ? beetstra_polydispersity(mean_diameter * surface) : 1);
  }
  return result;
}

}  // namespace

std::optional<BedPressure> bed_pressure(const Campaign& campaign, const Charge& charge,
                                        const std::optional<HeatBalance>& heat) {
  if (!campaign.scene.gas || charge.recipe_thickness <= 0) return std::nullopt;
  const Gas& gas = *campaign.scene.gas;
  double mass_flow = 0, enthalpy = 0;
  for (const Inlet& inlet : gas.inlets) {
    mass_flow += inlet.mass_flow;
    enthalpy += inlet.mass_flow * inlet.total_temperature;
  }
  const double stock_line = campaign.charging.stock_line;
  const double length = stock_line - inlet_height(campaign);
  if (mass_flow <= 0 || length <= 0) return std::nullopt;

  std::vector<double> depth, temperature;
  if (heat) {
    depth = heat->profile.depth;
    temperature = heat->profile.gas_temperature;
  } else {
    constexpr int cells = 500;
    for (int i = 0; i <= cells; ++i) depth.push_back(length * i / cells);
    temperature.assign(depth.size(), enthalpy / mass_flow);
  }

  BedPressure result;
  double pressure = gas.outlet_pressure, weight = 0;
  for (std::size_t n = 1; n < depth.size(); ++n) {
    const double height = depth[n] - depth[n - 1], middle = (depth[n] + depth[n - 1]) / 2;
    std::vector<double> shares = charge.volume_share;
    if (heat) {
      for (std::size_t k = 0; k < heat->kinds.size(); ++k) {
        if (middle >= heat->profile.end_depth[k]) shares[heat->kinds[k]] = 0;
      }
    }
    double present = 0;
    for (const double share : shares) present += share;
    if (present <= 0) continue;
    for (double& share : shares) share /= present;
    const double mass_flux = mass_flow / slot_area(campaign, stock_line - middle);
    const double mean_temperature = (temperature[n] + temperature[n - 1]) / 2;
    const SolidsAt solids =
        solids_at(campaign, charge.packing, shares, mass_flux, gas_viscosity(gas, mean_temperature));
    const double rise =
        2 * molar_gas_constant * mean_temperature / gas.molar_mass * solids.resistance * mass_flux * height;
    const double next = std::sqrt(pressure * pressure + rise);
    result.most_carried = std::max(result.most_carried, (next - pressure) / (solids.weight * height));
    weight += solids.weight * height;
    pressure = next;
  }
  result.at_inlets = pressure;
  result.drop = pressure - gas.outlet_pressure;
  result.weight_carried = result.drop / weight;
  return result;
}

}  // namespace cupola
