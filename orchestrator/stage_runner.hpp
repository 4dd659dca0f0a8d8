#pragma once
#include <filesystem>
#include <map>
#include <optional>
#include <string>

#include "orchestrator/launch/slurm_stage.hpp"
#include "orchestrator/progress_view.hpp"
#include "orchestrator/run_folder.hpp"
#include "orchestrator/signal_watch.hpp"
#include "orchestrator/stage_launcher.hpp"
#include "orchestrator/stage_state.hpp"

namespace cupola {

/// Brings stages to their end, wherever an earlier orchestrator left them.
///
/// - A finished stage is never run again; its hashes are checked.
/// - One that was interrupted goes on in its folder, from its checkpoint.
/// - One that still runs without an orchestrator is waited for.
/// - One whose numbers went bad (70) is tried again once, in a new folder and with the changed campaign keys its
/// message
///   asks for. Without such advice it would end the same, so it is not repeated; `cupola resume` tries once more.
/// - One that ends without a word (a crash, a killed rank) is started again once.
class StageRunner {
 public:
  /// All are kept by reference.
  StageRunner(RunFolder& run, const StageLauncher& launcher, SignalWatch& signals, ProgressView& view)
      : run_(run), launcher_(launcher), signals_(signals), view_(view), jobs_(run, launcher, signals, view) {}

  /// @param inputs files by the names of `Task::inputs`
  /// @return the finished task folder; none: stopped on request, with what is there left to go on from
  /// @throws Failure wrong_input, diverged, input_output: as the stage said, or because its result was refused
  std::optional<std::filesystem::path> finish(StagePlace place,
                                              const std::map<std::string, std::filesystem::path>& inputs);

 private:
  struct Patience {
    int starts = 0;       ///< of the stage by this orchestrator
    int retries = 0;      ///< attempts begun after one that went bad
    int deaths = 0;       ///< ends without a word
    int idle_jobs = 0;    ///< jobs on end that the cluster cut off before they came any further
    long last_step = -1;  ///< of the last job that was cut off
  };

  void accept(const StagePlace& place, const StageState& state);
  void wait_for_orphan(const StagePlace& place, const StageState& state);
  void begin_retry(StagePlace& place, const StageState& state, Patience& patience);
  /// Prepares and runs the attempt. @return false where a stop was asked for or the stage was stopped
  bool run_attempt(const StagePlace& place, const std::map<std::string, std::filesystem::path>& inputs,
                   Patience& patience);
  /// @return exit status, @param stoppable whether a request to stop is passed on
  int run_to_end(const StagePlace& place, const Command& command, const std::string& event, bool stoppable);
  /// @return false where it was stopped
  bool judge_end(const StagePlace& place, int status, Patience& patience);
  /// The same for a stage that was a job of Slurm.
  bool judge_job(const StagePlace& place, const JobEnd& end, Patience& patience);
  [[nodiscard]] Campaign campaign_with_advice() const;
  [[nodiscard]] nlohmann::json about(const StagePlace& place) const;
  [[nodiscard]] std::filesystem::path folder(const StagePlace& place) const;

  RunFolder& run_;
  const StageLauncher& launcher_;
  SignalWatch& signals_;
  ProgressView& view_;
  SlurmStage jobs_;
};

}  // namespace cupola
