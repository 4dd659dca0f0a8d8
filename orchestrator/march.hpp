#pragma once
#include <chrono>
#include <functional>
#include <optional>

#include "orchestrator/progress_view.hpp"
#include "orchestrator/run_folder.hpp"
#include "orchestrator/signal_watch.hpp"
#include "orchestrator/stage_launcher.hpp"
#include "physics/plan/cost.hpp"
#include "schemas/failure.hpp"

namespace cupola {

/// What a user may ask of one `cupola run` or `cupola resume`.
struct MarchOptions {
  std::optional<int> at_most;                                ///< episodes, instead of the campaign's limit
  std::optional<int> ranks;                                  ///< of the stages from now on, instead of the campaign's
  bool accept_versions = false;                              ///< goes on with other versions of program and libraries
  std::optional<int> until_episode;                          ///< leaves after this one; the campaign is not over then
  std::chrono::duration<double> stop_within = longest_stop;  ///< after this a stage that was asked to stop is killed
  bool one_stage = false;  ///< leaves after the next stage that it has brought to its end
};

/// Called whenever there is something new to show: `report`.
using AfterStage = std::function<void()>;

/// Brings the stages of episode after episode to their end (`stage_order`) until the campaign's criteria are met or its
/// limit is reached.
/// @return done: converged; stopped: at its limit, steady without melting, or on request
/// @throws Failure as StageRunner::finish
ExitCode march(RunFolder& run, const StageLauncher& launcher, SignalWatch& signals, ProgressView& view,
               const MarchOptions& options, const AfterStage& after_stage);

}  // namespace cupola
