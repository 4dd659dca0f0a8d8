#pragma once
#include <cstddef>

#include "physics/plan/charge.hpp"
#include "physics/plan/dem_time_step.hpp"
#include "schemas/campaign.hpp"

namespace cupola {

/// Measured rates the estimate rests on (docs/models.md says where they come from).
inline constexpr double dem_parcel_steps_per_core_second = 2.1e6;
inline constexpr double core_seconds_per_tracer_step = 3e-7;
inline constexpr double core_seconds_per_gas_solution_of_a_cell = 1e-5;

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
  int ranks = 1;
  int fewest_episodes = 0, most_episodes = 0;  ///< a remaining change can be extrapolated from the third episode on
  [[nodiscard]] double episode_wall_seconds() const { return (dem_core_seconds + tracer_core_seconds) / ranks; }
  /// How long a stage that is asked to stop goes on, before it writes its checkpoint: a block, or a step, at most.
  [[nodiscard]] double dem_block_wall_seconds() const { return dem_core_seconds / dem_blocks / ranks; }
  [[nodiscard]] double tracer_step_wall_seconds() const { return tracer_core_seconds / tracer_steps / ranks; }
};

Cost expected_cost(const Campaign& campaign, const Charge& charge, const DemTimeStep& dem_step, double parcels,
                   std::size_t cells);

}  // namespace cupola
