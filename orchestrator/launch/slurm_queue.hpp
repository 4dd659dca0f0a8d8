#pragma once
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "schemas/campaign.hpp"

namespace cupola {

/// A job as Slurm sees it.
struct JobState {
  enum class Phase {
    waiting,      ///< in the queue, for the first time or again
    running,      ///< started and not quite ended
    ended,        ///< over, in whatever way
    forgotten,    ///< Slurm knows it no longer: over for some time
    unreachable,  ///< Slurm does not answer at present
  };
  Phase phase = Phase::unreachable;
  std::string word;           ///< Slurm's own: `PENDING`, `TIMEOUT`, …
  std::string reason;         ///< Slurm's own: `Resources`, `NonZeroExitCode`, …
  std::optional<int> status;  ///< exit status of an ended one, 128 + signal where one ended it
  int restarts = 0;           ///< how often Slurm has put it back into the queue
};

/// A job to be submitted.
struct BatchJob {
  std::string name;
  std::filesystem::path script;
  std::filesystem::path folder;  ///< it works there
  std::filesystem::path log;     ///< standard output and error are appended here
  std::string after = {};        ///< begins only after this job has ended; empty: at once
  bool after_any_end = false;    ///< … whether that one ended well or not
  std::string array = {};        ///< numbers of an array's members, `0-3,7%2`: at most two at once; empty: one job
};

/// The whole call of sbatch for a job.
std::vector<std::string> sbatch_words(const Launch& launch, const BatchJob& job);

/// What `squeue --format=%T|%r` and `scontrol --oneliner show job` say about a job.
JobState job_state_from(const std::string& squeue_line, const std::string& scontrol_line);
/// What `sacct --parsable2 --format=State,ExitCode` says about an ended one.
JobState job_state_from_accounting(const std::string& sacct_line);

/// Slurm's queue, through its own programs.
class SlurmQueue {
 public:
  /// @return the job's number
  /// @throws Failure wrong_input: Slurm refuses the job; input_output: Slurm does not answer
  static std::string submit(const Launch& launch, const BatchJob& job);

  static JobState state(const std::string& job);
  /// Numbers of the jobs of this name that have not ended; none where Slurm does not answer.
  static std::optional<std::vector<std::string>> unfinished(const std::string& name);

  /// Asks a running job for its checkpoint and its end, as its time limit would (SIGUSR1).
  static void ask_to_stop(const std::string& job);
  /// Takes jobs out of the queue, killing those that run.
  static void cancel(const std::vector<std::string>& jobs);
  /// Puts a job back into the queue; ends it where it runs. @return whether Slurm did so
  static bool requeue(const std::string& job);
};

}  // namespace cupola
