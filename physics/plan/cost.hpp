#pragma once
#include <chrono>
#include <cstddef>

#include "physics/plan/charge.hpp"
#include "physics/plan/dem_time_step.hpp"
#include "physics/plan/rates.hpp"
#include "schemas/campaign.hpp"

namespace cupola {

/// Expected work of one episode; the filling and settling of the first bed is not in it.
struct Cost {
  double dem_process_seconds = 0;  ///< simulated, at most
  double dem_steps = 0;
  double dem_blocks = 0;
  double dem_core_seconds = 0;  ///< contacts and, where gas is on, one gas solution a block
  double tracers = 0;
  double tracer_time_step = 0;  ///< s
  double tracer_steps = 0;
  double tracer_core_seconds = 0;  ///< motion, heat and one gas solution a step
  /// The same by what it is for, core seconds an episode; zero for what the scene does not need.
  struct Parts {
    double contacts = 0, dem_gas = 0, motion = 0, exchange = 0, conduction = 0, gas_flow = 0, gas_energy = 0;
  };
  Parts parts;
  double dem_memory = 0, tracer_memory = 0;  ///< bytes at most, over all ranks (docs/models.md)
  Rates rates;                               ///< what it rests on
  int ranks = 1;
  double busy_cores = 1;  ///< ranks that really work at once: without Slurm no more than this machine has cores
  int fewest_episodes = 0, most_episodes = 0;  ///< a remaining change can be extrapolated from the third episode on
  [[nodiscard]] double dem_wall_seconds() const { return dem_core_seconds / busy_cores; }
  [[nodiscard]] double tracer_wall_seconds() const { return tracer_core_seconds / busy_cores; }
  [[nodiscard]] double episode_wall_seconds() const { return dem_wall_seconds() + tracer_wall_seconds(); }
  /// How long a stage that is asked to stop goes on, before it writes its checkpoint: a block, or a step, at most.
  [[nodiscard]] double dem_block_wall_seconds() const { return dem_wall_seconds() / dem_blocks; }
  [[nodiscard]] double tracer_step_wall_seconds() const { return tracer_wall_seconds() / tracer_steps; }
};

/// How long a stage that was asked to stop may take at most, unless `--stop-within` says otherwise: then it is killed.
inline constexpr std::chrono::minutes longest_stop{5};

Cost expected_cost(const Campaign& campaign, const Charge& charge, const DemTimeStep& dem_step, double parcels,
                   std::size_t cells, const Rates& rates = {});

}  // namespace cupola
