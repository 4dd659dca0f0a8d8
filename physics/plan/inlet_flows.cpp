#include "physics/plan/inlet_flows.hpp"

#include <algorithm>
#include <cmath>

#include "physics/closures/gas_properties.hpp"
#include "physics/closures/gas_state.hpp"
#include "physics/plan/charge.hpp"
#include "physics/plan/heat_balance.hpp"

namespace cupola {
namespace {

double opening_of(const Campaign& campaign, const Inlet& inlet) {
  return inlet.side == Inlet::Side::bottom ? slot_area(campaign, campaign.bottom()) : inlet.size[0] * inlet.size[1];
}

/// Mass flow of an inlet of a given velocity at a static pressure, kg/s.
double blown(const Gas& gas, const Inlet& inlet, double opening, double pressure) {
  const double temperature = inlet.total_temperature - inlet.velocity * inlet.velocity /
                                                           (2 * GasState(gas).heat_capacity(inlet.total_temperature));
  return temperature > 0 ? gas_density(pressure, temperature, gas.molar_mass) * inlet.velocity * opening : 0;
}

}  // namespace

std::optional<Campaign> with_mass_flows(const Campaign& campaign, const Charge& charge) {
  Campaign result = campaign;
  if (!campaign.scene.gas) return result;
  auto& inlets = result.scene.gas->inlets;
  const Gas& gas = *campaign.scene.gas;
  if (std::all_of(inlets.begin(), inlets.end(),
                  [](const Inlet& inlet) { return inlet.given == Inlet::Given::mass_flow; })) {
    return result;
  }
  for (Inlet& inlet : inlets) {
    const double opening = opening_of(campaign, inlet);
    if (inlet.given == Inlet::Given::velocity) inlet.mass_flow = blown(gas, inlet, opening, gas.outlet_pressure);
    if (inlet.given == Inlet::Given::pressure) {  // a slow flow to begin with
      inlet.mass_flow = 10 * gas_density(inlet.pressure, inlet.total_temperature, gas.molar_mass) * opening;
    }
  }
  constexpr int most_iterations = 200;
  constexpr double close = 1e-6;
  for (int iteration = 0; iteration < most_iterations; ++iteration) {
    const auto pressure = bed_pressure(result, charge, heat_balance(result, charge));
    if (!pressure) return result;
    double change = 0;
    for (Inlet& inlet : inlets) {
      double wanted = inlet.mass_flow;
      if (inlet.given == Inlet::Given::velocity) {
        wanted = blown(gas, inlet, opening_of(campaign, inlet), pressure->at_inlets);
      } else if (inlet.given == Inlet::Given::pressure) {
        // The squares of the pressures differ by about the square of the mass flow.
        const double outlet = gas.outlet_pressure * gas.outlet_pressure;
        wanted *= std::sqrt((inlet.pressure * inlet.pressure - outlet) /
                            std::max(pressure->at_inlets * pressure->at_inlets - outlet, 1e-12 * outlet));
      }
      change = std::max(change, std::abs(wanted / inlet.mass_flow - 1));
      inlet.mass_flow += 0.5 * (wanted - inlet.mass_flow);
      if (!std::isfinite(inlet.mass_flow) || !(inlet.mass_flow > 0)) return std::nullopt;
    }
    if (change < close) return result;
  }
  return std::nullopt;
}

}  // namespace cupola
