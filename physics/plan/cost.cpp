#include "physics/plan/cost.hpp"

#include <algorithm>
#include <cmath>

namespace cupola {

Cost expected_cost(const Campaign& campaign, const Charge& charge, const DemTimeStep& dem_step, double parcels,
                   std::size_t cells) {
  const auto mesh_cells = static_cast<double>(cells);
  const bool gas = campaign.scene.gas.has_value();
  Cost cost;
  cost.ranks = std::max(1, campaign.launch.ranks);
  cost.most_episodes = campaign.converged.at_most;
  cost.fewest_episodes = std::min(cost.most_episodes, 2 + std::max(1, campaign.converged.for_episodes));
  cost.dem_process_seconds = campaign.dem.at_most;
  cost.dem_steps = std::ceil(cost.dem_process_seconds / dem_step.step);
  cost.dem_blocks = std::max(1., std::ceil(cost.dem_process_seconds / campaign.dem.block));
  cost.dem_core_seconds = cost.dem_steps * parcels / dem_parcel_steps_per_core_second;
  if (gas && campaign.dem.gas != DemSettings::GasModel::none) {
    const double blocks = cost.dem_process_seconds / campaign.dem.block;
    cost.dem_core_seconds += blocks * mesh_cells * core_seconds_per_gas_solution_of_a_cell;
  }

  cost.tracers = std::max(parcels, campaign.tracer.tracers_per_cell * mesh_cells);
  // As the tracer stage chooses it where the bed moves evenly: a fifth of the passage of a cell or of the thinnest
  // layer.
  constexpr double passage_share = 0.2;
  double height = campaign.scene.mesh.cell;
  for (const double thickness : charge.layer_thickness) {
    if (thickness > 0) height = std::min(height, thickness);
  }
  cost.tracer_time_step =
      campaign.tracer.time_step.value_or(passage_share * height / std::max(campaign.descent_rate, 1e-12));
  cost.tracer_steps = std::ceil(campaign.tracer.duration / cost.tracer_time_step);
  double per_step = cost.tracers * core_seconds_per_tracer_step;
  if (gas && campaign.tracer.gas != TracerSettings::GasModel::none) {
    per_step += mesh_cells * core_seconds_per_gas_solution_of_a_cell;
  }
  cost.tracer_core_seconds = cost.tracer_steps * per_step;
  return cost;
}

}  // namespace cupola
