#pragma once
#include <chrono>
#include <filesystem>
#include <optional>
#include <string>

#include "orchestrator/launch/slurm_stage.hpp"
#include "orchestrator/progress_view.hpp"
#include "orchestrator/run_folder.hpp"
#include "orchestrator/signal_watch.hpp"
#include "orchestrator/stage_launcher.hpp"
#include "orchestrator/stage_orders.hpp"
#include "orchestrator/stage_state.hpp"

namespace cupola {

/// Brings stages to their end, wherever an earlier orchestrator left them.
///
/// - A finished stage is never run again; its hashes are checked.
/// - One that was interrupted goes on in its folder, from its checkpoint.
/// - One whose folder was taken away begins anew, unless later stages were made from what it held.
/// - One that still runs without an orchestrator is waited for.
/// - One whose numbers went bad (70) is tried again once, in a new folder, from its last checkpoint and with the
/// changed
///   campaign keys its message asks for. Without such advice it would end the same, so it is not repeated; `cupola
///   resume` tries once more.
/// - One that ends without a word (a crash, a killed rank) is started again, after a wait that grows, until it has died
///   four times without a new checkpoint in between.
class StageRunner {
 public:
  /// All but `stop_within` are kept by reference.
  /// @param stop_within a stage that was asked to stop and has not left by then is killed: it has lost what it did
  /// since its last checkpoint
  StageRunner(RunFolder& run, const StageLauncher& launcher, SignalWatch& signals, ProgressView& view,
              std::chrono::duration<double> stop_within)
      : run_(run),
        launcher_(launcher),
        signals_(signals),
        view_(view),
        jobs_(run, launcher, signals, view),
        stop_within_(stop_within) {}

  /// @return the finished task folder; none: stopped on request, with what is there left to go on from
  /// @throws Failure wrong_input, diverged, input_output: as the stage said, or because its result was refused
  std::optional<std::filesystem::path> finish(StagePlace place, const StageOrder& order);

  /// Wall time spent waiting for stages and their preparation so far: the rest is the orchestrator's own.
  [[nodiscard]] std::chrono::duration<double> waited() const { return waited_; }

 private:
  struct Patience {
    int starts = 0;       ///< of the stage by this orchestrator
    int retries = 0;      ///< attempts begun after one that went bad
    int deaths = 0;       ///< ends without a word since the checkpoint last got on
    long step_lived = 0;  ///< step of the checkpoint at the last death
    int idle_jobs = 0;    ///< jobs on end that the cluster cut off before they came any further
    long last_step = -1;  ///< of the last job that was cut off
  };

  void accept(const StagePlace& place, const StageState& state);
  void wait_for_orphan(const StagePlace& place, const StageState& state);
  /// Where the journal knows of a folder that is not there any more: what it says of it no longer counts.
  /// @throws Failure input_output where later stages were made from it
  void begin_anew_where_removed(const StagePlace& place);
  void begin_retry(StagePlace& place, const StageState& state, Patience& patience);
  /// Prepares and runs the attempt. @return false where a stop was asked for or the stage was stopped
  bool run_attempt(const StagePlace& place, const StageOrder& order, Patience& patience);
  /// Sees that the task is there, and the one the journal knows.
  void make_task(const StagePlace& place, const StageOrder& order);
  /// Sees that its OpenFOAM case is prepared. @return exit status of the preparation; 0 where there was nothing to do
  int make_ready(const StagePlace& place);
  /// @param content of the event, @param stoppable whether a request to stop is passed on
  /// @return exit status
  int run_to_end(const StagePlace& place, Command command, const std::string& event, nlohmann::json content,
                 bool stoppable);
  /// Waits before a stage that died is started again. @throws Failure where it dies again and again
  void be_patient(const StagePlace& place, int status, Patience& patience);
  /// @return false where it was stopped
  bool judge_end(const StagePlace& place, int status, Patience& patience);
  /// The same for a stage that was a job of Slurm.
  bool judge_job(const StagePlace& place, const JobEnd& end, Patience& patience);
  /// `dem stage of episode 2`
  [[nodiscard]] static std::string name_of(const StagePlace& place);
  [[nodiscard]] Campaign campaign_in_force() const;
  [[nodiscard]] int ranks() const;
  [[nodiscard]] nlohmann::json about(const StagePlace& place) const;
  [[nodiscard]] std::filesystem::path folder(const StagePlace& place) const;

  RunFolder& run_;
  const StageLauncher& launcher_;
  SignalWatch& signals_;
  ProgressView& view_;
  SlurmStage jobs_;
  std::chrono::duration<double> stop_within_;
  std::chrono::duration<double> waited_{0};
};

}  // namespace cupola
