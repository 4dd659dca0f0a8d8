#include "physics/plan/cost.hpp"

#include <algorithm>
#include <cmath>
#include <thread>

namespace cupola {
namespace {

// Largest resident sizes of the two programs on one rank, fitted through two cases (docs/models.md), bytes.
constexpr double memory_of_dem = 100e6;    // a rank, before any parcel
constexpr double memory_of_tracer = 78e6;  // a rank, before any tracer
constexpr double memory_a_cell = 3e3;      // a rank: every rank holds the whole mesh
constexpr double memory_a_parcel = 2.1e3;  // contacts, neighbours, the packing
constexpr double memory_a_tracer = 230;

}  // namespace

Cost expected_cost(const Campaign& campaign, const Charge& charge, const DemTimeStep& dem_step, double parcels,
                   std::size_t cells, const Rates& rates) {
  const auto mesh_cells = static_cast<double>(cells);
  const bool gas = campaign.scene.gas.has_value();
  const bool heat = campaign.heat.has_value();
  Cost cost;
  cost.rates = rates;
  cost.ranks = std::max(1, campaign.launch.ranks);
  const unsigned cores = std::thread::hardware_concurrency();
  cost.busy_cores = campaign.launch.slurm || cores == 0 ? cost.ranks : std::min<double>(cost.ranks, cores);
  cost.most_episodes = campaign.converged.at_most;
  cost.fewest_episodes = std::min(cost.most_episodes, 2 + std::max(1, campaign.converged.for_episodes));
  cost.dem_process_seconds = campaign.dem.at_most;
  cost.dem_steps = std::ceil(cost.dem_process_seconds / dem_step.step);
  cost.dem_blocks = std::max(1., std::ceil(cost.dem_process_seconds / campaign.dem.block));
  cost.parts.contacts = cost.dem_steps * parcels * rates.contacts;
  if (gas && campaign.dem.gas != DemSettings::GasModel::none) {
    cost.parts.dem_gas = cost.dem_process_seconds / campaign.dem.block * mesh_cells * rates.dem_gas;
  }
  cost.dem_core_seconds = cost.parts.contacts + cost.parts.dem_gas;

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
  cost.parts.motion = cost.tracer_steps * cost.tracers * rates.motion;
  const double cell_steps = cost.tracer_steps * mesh_cells;
  const bool tracer_gas = gas && campaign.tracer.gas != TracerSettings::GasModel::none;
  const bool inertia = campaign.tracer.gas == TracerSettings::GasModel::navier_stokes;
  if (tracer_gas) cost.parts.gas_flow = cell_steps * (inertia ? rates.gas_flow_navier_stokes : rates.gas_flow);
  if (heat && tracer_gas) {
    cost.parts.exchange = cell_steps * rates.exchange;
    cost.parts.gas_energy = cell_steps * rates.gas_energy;
  }
  if (heat) cost.parts.conduction = cell_steps * rates.conduction;
  cost.tracer_core_seconds =
      cost.parts.motion + cost.parts.gas_flow + cost.parts.exchange + cost.parts.gas_energy + cost.parts.conduction;
  cost.dem_memory = cost.ranks * (memory_of_dem + mesh_cells * memory_a_cell) + parcels * memory_a_parcel;
  cost.tracer_memory = cost.ranks * (memory_of_tracer + mesh_cells * memory_a_cell) + cost.tracers * memory_a_tracer;
  return cost;
}

}  // namespace cupola
