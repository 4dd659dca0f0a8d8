#pragma once
#include <optional>
#include <string>
#include <vector>

#include "orchestrator/run_folder.hpp"
#include "orchestrator/stage_launcher.hpp"

namespace cupola {

/// A whole campaign in Slurm's queue: one job (a *link*) a stage, each beginning after the one before has ended well,
/// with no orchestrator left running.  A link is `cupola resume` for one stage.  At its time limit it stops the stage
/// with a checkpoint and goes back into the queue; where the campaign has ended or failed it takes the rest of the
/// chain out of the queue.  The journal says `chain-submitting` (with the name that all links have and no other job),
/// `chain-submitted`, `chain-ended`.
class SlurmChain {
 public:
  /// Kept by reference.
  explicit SlurmChain(RunFolder& run) : run_(run) {}

  /// Submits the links of all stages that are still to be run.
  /// @param at_most episodes, instead of the campaign's limit @return the jobs' numbers, first to last
  /// @throws Failure wrong_input: no `launch.slurm`, or Slurm refuses a job; input_output: Slurm does not answer
  std::vector<std::string> submit(const StageLauncher& launcher, std::optional<int> at_most);

  /// @throws Failure held: links of a chain that was submitted wait or run, and this process is none of them;
  /// input_output: Slurm cannot be asked
  void require_none() const;

  /// Takes all links but our own out of the queue.
  void end();

 private:
  [[nodiscard]] std::string open_name() const;

  RunFolder& run_;
};

}  // namespace cupola
