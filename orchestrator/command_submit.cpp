#include <fmt/format.h>

#include <chrono>
#include <cstdlib>

#include "orchestrator/commands.hpp"
#include "orchestrator/go_on.hpp"
#include "orchestrator/launch/slurm_chain.hpp"
#include "orchestrator/launch/slurm_queue.hpp"

namespace cupola {
namespace {

ExitCode submit_chain(RunFolder& run, const MarchOptions& options) {
  const auto jobs = SlurmChain(run).submit(StageLauncher(StageLauncher::own_folder()), options.at_most);
  fmt::print(
      "{}: submitted as a chain of {} jobs, {} to {}, one a stage; those that are not needed leave the queue.\n"
      "  cupola status {}\n",
      run.campaign().name, jobs.size(), jobs.front(), jobs.back(), run.path().string());
  return ExitCode::done;
}

/// Opens the run folder; whoever only submits or looks holds it for a moment, which must not break the chain.
std::unique_ptr<RunFolder> open_patiently(const std::filesystem::path& folder, SignalWatch& signals) {
  constexpr int most_tries = 300;
  for (int tries = 1;; ++tries) {
    try {
      return RunFolder::open(folder);
    } catch (const Failure& failure) {
      if (failure.code() != ExitCode::held || tries >= most_tries || signals.stop_requests() > 0) throw;
    }
    signals.wait(std::chrono::seconds(1));
  }
}

bool has_ended(const RunFolder& run) {
  const auto& records = run.journal().records();
  return !records.empty() && records.back().value("event", "") == "campaign-ended";
}

}  // namespace

ExitCode submit(const std::filesystem::path& campaign_file, const std::optional<std::filesystem::path>& folder,
                const MarchOptions& options) {
  return submit_chain(*open_for(campaign_file, folder), options);
}

ExitCode submit_again(const std::filesystem::path& folder, const MarchOptions& options) {
  return submit_chain(*RunFolder::open(folder), options);
}

ExitCode chain_link(const std::filesystem::path& folder, MarchOptions options) {
  SignalWatch signals;
  options.one_stage = true;
  {
    const auto run = open_patiently(folder, signals);
    try {
      go_on(*run, options, signals);
    } catch (const Failure&) {
      SlurmChain(*run).end();
      throw;
    }
    if (has_ended(*run)) {
      SlurmChain(*run).end();
      return ExitCode::done;
    }
  }
  if (signals.stop_requests() == 0) return ExitCode::done;  // the next link begins now
  // At its time limit a link goes back into the queue and the rest of the chain waits for it. Where somebody cancelled
  // it (SIGTERM), it ends, and with it the chain; preempted jobs Slurm puts back itself.
  const char* job = std::getenv("SLURM_JOB_ID");
  if (signals.time_is_up() && job != nullptr && !SlurmQueue::requeue(job))
    throw Failure(ExitCode::stopped,
                  fmt::format("job {} cannot be put back into the queue; `cupola resume {} --submit` goes on.", job,
                              folder.string()));
  return ExitCode::stopped;
}

}  // namespace cupola
