#pragma once
#include <filesystem>
#include <optional>
#include <string>

#include "orchestrator/launch/slurm_queue.hpp"
#include "orchestrator/progress_view.hpp"
#include "orchestrator/run_folder.hpp"
#include "orchestrator/signal_watch.hpp"
#include "orchestrator/stage_launcher.hpp"

namespace cupola {

/// How the job of a stage ended.
struct JobEnd {
  std::optional<int> status;  ///< of the stage; none: Slurm does not know, the stage's own files must say
  bool cut_off = false;       ///< by the cluster (time limit, preemption, node failure): the next job goes on
  bool by_hand = false;       ///< somebody cancelled it
  std::string sentence;       ///< for people: `job 12: TIMEOUT`
};

/// Stages as jobs of Slurm.  What was submitted stands in the journal (`job-submitting` before sbatch, `job-submitted`
/// after it, `job-ended`), so that an orchestrator that begins anew finds its jobs again: by number, or, where it died
/// between sbatch and the journal, by the name that only this job has.
class SlurmStage {
 public:
  /// All are kept by reference.
  SlurmStage(RunFolder& run, const StageLauncher& launcher, SignalWatch& signals, ProgressView& view)
      : run_(run), launcher_(launcher), signals_(signals), view_(view) {}

  /// Submits a job for an attempt whose task is there and follows it to its end.  A request to stop is passed on; a job
  /// that still waits is taken out of the queue.
  /// @throws Failure wrong_input, input_output: Slurm takes no job
  JobEnd run(const StagePlace& place);

  /// Follows the job that an earlier orchestrator submitted for this attempt; none where there is none.
  std::optional<JobEnd> find_again(const StagePlace& place);

 private:
  JobEnd follow(const StagePlace& place, const std::string& job);
  [[nodiscard]] nlohmann::json about(const StagePlace& place) const;

  RunFolder& run_;
  const StageLauncher& launcher_;
  SignalWatch& signals_;
  ProgressView& view_;
};

}  // namespace cupola
