#pragma once
#include <optional>
#include <string>
#include <vector>

#include "physics/plan/charge.hpp"
#include "physics/plan/counter_current_bed.hpp"
#include "schemas/campaign.hpp"

namespace cupola {

/// "Will it melt?": the campaign as a one-dimensional counter-current bed from the stock line down to the inlets, with
/// the campaign's own closures: Ranz-Marshall x nusselt_factor on 6 a/d of grain surface, layer exchange (Carson,
/// layers flattened or stretched with the slot's area), wall loss on the gas, slot profile; softening species leave
/// where they melt, only the others go on. Left out: conduction along the height, everything across the slot, freeboard
/// and hearth.
struct HeatBalance {
  double gas_enters_at_height = 0;       ///< m, flow-weighted height of the inlets
  double gas_mass_flow = 0;              ///< kg/s
  double gas_temperature = 0;            ///< K, flow-weighted total temperature of the inlets
  double gas_heat_capacity_flow = 0;     ///< W/K
  double solids_heat_capacity_flow = 0;  ///< W/K
  std::vector<double>
      transfer_units;  ///< by species: its surface's conductance from the stock line to its end over its own flow
  std::vector<std::optional<double>>
      melting_height;  ///< m, by species; none: does not melt (cannot, or is not hot enough)
  std::vector<std::optional<double>> softening_height;  ///< m
  std::vector<double> leaves_at;                        ///< K, by species: temperature at its end
  double top_gas_temperature = 0;                       ///< K
  std::vector<std::size_t> kinds;                       ///< species of each kind in `profile`: those that are charged
  CounterCurrentSolution profile;                       ///< depth from the stock line
  [[nodiscard]] double ratio() const { return solids_heat_capacity_flow / gas_heat_capacity_flow; }
};

/// @returns nothing for a scene without heat, without gas inlets or without descent
std::optional<HeatBalance> heat_balance(const Campaign& campaign, const Charge& charge);

/// Flow-weighted mean height of the inlets, m (the bottom for an inlet there); the bottom without any.
double inlet_height(const Campaign& campaign);

}  // namespace cupola
