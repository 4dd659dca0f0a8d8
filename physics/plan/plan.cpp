#include "physics/plan/plan.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <numeric>

#include "physics/closures/gas_state.hpp"
#include "physics/plan/expected_parcels.hpp"
#include "physics/plan/inlet_flows.hpp"
#include "physics/plan/inlet_limit.hpp"
#include "physics/plan/physics_pieces.hpp"
#include "physics/plan/scene_warnings.hpp"
#include "schemas/failure.hpp"

namespace cupola {
namespace {

MeshPlan mesh_plan(const Campaign& campaign) {
  MeshPlan mesh;
  mesh.counts = mesh_counts(campaign);
  mesh.volume = slot_volume(campaign, campaign.bottom(), campaign.top());
  std::vector<double> edges;
  const auto between = [&](const std::vector<double>& planes, const std::vector<int>& cells) {
    for (std::size_t i = 0; i < cells.size(); ++i) edges.push_back((planes[i + 1] - planes[i]) / cells[i]);
  };
  between(mesh.counts.levels, mesh.counts.rows);
  between(mesh.counts.sections, mesh.counts.slices);
  for (const double z : mesh.counts.levels) edges.push_back(campaign.half_width(z) / mesh.counts.columns);
  mesh.shortest_edge = *std::min_element(edges.begin(), edges.end());
  mesh.longest_edge = *std::max_element(edges.begin(), edges.end());
  return mesh;
}

std::vector<InletPlan> inlet_plans(const Campaign& campaign, double static_pressure) {
  std::vector<InletPlan> plans;
  if (!campaign.scene.gas) return plans;
  const Gas& gas = *campaign.scene.gas;
  for (const Inlet& inlet : gas.inlets) {
    InletPlan plan{inlet.name, inlet.size[0] * inlet.size[1], {}};
    if (inlet.side == Inlet::Side::bottom) plan.opening = slot_area(campaign, campaign.bottom());
    plan.state = inlet_state(inlet.mass_flow, inlet.total_temperature, plan.opening, static_pressure, gas.molar_mass,
                             GasState(gas).heat_capacity(inlet.total_temperature));
    plans.push_back(plan);
  }
  return plans;
}

void judge_inlets(const Campaign& campaign, Plan& plan) {
  if (!campaign.scene.gas) return;
  const Gas& gas = *campaign.scene.gas;
  for (std::size_t i = 0; i < plan.inlets.size(); ++i) {
    const InletPlan& inlet = plan.inlets[i];
    const Inlet& asked = gas.inlets[i];
    const std::string refusal = inlet_refusal(gas, asked, inlet.state);
    if (!refusal.empty()) {
      plan.refusals.push_back(refusal);
    } else if (inlet.state.mach_number > mach_to_warn) {
      plan.warnings.push_back(
          fmt::format("The gas enters '{}' at Mach {:.2f} (above {}): what the gas model leaves out matters there",
                      inlet.name, inlet.state.mach_number, mach_to_warn));
    }
  }
}

void judge_batches(const Campaign& campaign, Plan& plan) {
  // A freshly charged batch is looser than the bed.
  constexpr double batch_packing = 0.55;
  const double top = std::max(campaign.top(), campaign.charging.stock_line);
  const double free_volume = slot_volume(campaign, campaign.charging.stock_line, campaign.hopper_top());
  for (std::size_t i = 0; i < campaign.charging.layers.size(); ++i) {
    double volume = 0;
    for (const auto& [name, mass] : campaign.charging.layers[i]) {
      volume += mass / campaign.species[campaign.species_index(name)].density / batch_packing;
    }
    if (volume > free_volume) {
      plan.refusals.push_back(fmt::format(
          "charging.layers[{}]: {:.3g} m3 of bulk do not fit into the {:.3g} m3 above the stock line at {} m; raise "
          "charging.hopper_height to {:.2f} m or charge less at a time",
          i, volume, free_volume, campaign.charging.stock_line,
          (volume - slot_volume(campaign, campaign.charging.stock_line, top)) / slot_area(campaign, top) + 0.5));
    }
  }
}

void judge_heat(const Campaign& campaign, Plan& plan) {
  if (!plan.heat) return;
  const HeatBalance& heat = *plan.heat;
  double raceway_top = heat.gas_enters_at_height;
  for (const Raceway& raceway : campaign.raceways) raceway_top = std::max(raceway_top, raceway.box[1][2]);
  const double margin = std::max(1.0, 2 * campaign.scene.mesh.cell);
  for (const std::size_t i : heat.kinds) {
    const Species& species = campaign.species[i];
    if (!species.softening) continue;
    if (!heat.melting_height[i]) {
      plan.warnings.push_back(
          fmt::format("The {} never melts: it reaches {:.0f} K of {:.0f} K at {:.2f} m. More or hotter gas, a slower "
                      "descent or a taller shaft "
                      "would melt it (heat-capacity flow of solids over gas is {:.2f})",
                      species.name, heat.leaves_at[i], species.softening->melted,
                      std::max(species.none_below, heat.gas_enters_at_height), heat.ratio()));
    } else if (*heat.melting_height[i] < raceway_top + margin) {
      plan.warnings.push_back(
          fmt::format("The {} melts at {:.2f} m, within {:.2f} m of the raceways (top {:.2f} m): little more solids "
                      "or less gas and it will not melt",
                      species.name, *heat.melting_height[i], margin, raceway_top));
    } else if (*heat.melting_height[i] > campaign.charging.stock_line - margin) {
      plan.warnings.push_back(fmt::format(
          "The {} melts at {:.2f} m, within {:.2f} m of the stock line ({:.2f} m): too much gas for this charge",
          species.name, *heat.melting_height[i], margin, campaign.charging.stock_line));
    }
  }
}

void judge_bed(const Campaign& campaign, Plan& plan) {
  if (plan.cost.busy_cores < plan.cost.ranks)
    plan.warnings.push_back(
        fmt::format("launch.ranks is {}, but this machine has {:.0f} cores: ranks take turns on them", plan.cost.ranks,
                    plan.cost.busy_cores));
  // Wider parcels come in lumps: their shares of cells are found by points.
  constexpr double widest = 2;  // cells
  for (const SpeciesPlan& species : plan.species) {
    const double cells = species.parcel_diameter / plan.mesh.shortest_edge;
    if (campaign.dem.void_fraction == DemSettings::VoidFraction::divided && cells > widest)
      plan.warnings.push_back(fmt::format(
          "Parcels of {} are {:.1f} times as wide as the smallest cell: some cells get more than they hold; "
          "write dem.void_fraction: smoothed, or take larger cells",
          species.name, cells));
  }
  if (plan.pressure && plan.pressure->most_carried > 0.5) {
    plan.warnings.push_back(fmt::format("The gas carries {:.0f} % of the bed's weight where it is fastest{}",
                                        100 * plan.pressure->most_carried,
                                        plan.pressure->most_carried > 1 ? ": the bed will be lifted there" : ""));
  }
  if (!campaign.raceways.empty() && plan.charge.total_mass_rate() > 0 && plan.dem_speed_up == 0) {
    plan.warnings.push_back(
        "Raceways remove nothing in the DEM stage, or no species reaches them: the bed will not move");
  }
}

}  // namespace

Plan make_plan(const Campaign& asked, const Rates& rates) {
  Plan plan;
  plan.charge = charge_of(asked);
  const auto flowing = with_mass_flows(asked, plan.charge);
  if (!flowing) {
    plan.refusals.push_back(
        "scene.gas.inlets: no steady flow has the velocities or pressures asked for: the mass flow grows with the "
        "pressure without limit; give mass_flow instead, or less gas");
  }
  const Campaign& campaign = flowing ? *flowing : asked;
  plan.campaign = campaign.name;
  plan.stock_line = campaign.charging.stock_line;
  plan.mesh = mesh_plan(campaign);
  plan.bed_volume = slot_volume(campaign, campaign.bottom(), campaign.charging.stock_line);
  plan.hopper_top = campaign.hopper_top();
  plan.dem_speed_up = dem_speed_up(campaign, plan.charge);
  plan.dem_step = dem_time_step(campaign);

  const std::vector<double> parcels = expected_parcels(campaign, plan.charge.volume_share, plan.charge.packing);
  for (std::size_t i = 0; i < parcels.size(); ++i) {
    const Species& species = campaign.species[i];
    plan.species.push_back({species.name, species.parcel_diameter(), std::pow(species.coarse_graining, 3), parcels[i]});
  }
  plan.heat = heat_balance(campaign, plan.charge);
  plan.pressure = bed_pressure(campaign, plan.charge, plan.heat);
  if (campaign.scene.gas) {
    plan.inlets = inlet_plans(campaign, plan.pressure ? plan.pressure->at_inlets : campaign.scene.gas->outlet_pressure);
  }
  plan.cost = expected_cost(campaign, plan.charge, plan.dem_step, std::accumulate(parcels.begin(), parcels.end(), 0.0),
                            plan.mesh.counts.cells(), rates);
  plan.physics = physics_pieces(campaign, plan.cost.parts);
  plan.warnings = scene_warnings(campaign);
  judge_inlets(campaign, plan);
  judge_batches(campaign, plan);
  judge_heat(campaign, plan);
  judge_bed(campaign, plan);
  return plan;
}

void refuse(const Plan& plan) {
  if (plan.refusals.empty()) return;
  throw Failure(ExitCode::wrong_input, fmt::format("{}", fmt::join(plan.refusals, "\n")));
}

}  // namespace cupola
