#include "orchestrator/launch/slurm_chain.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cstdlib>

#include "orchestrator/launch/job_name.hpp"
#include "orchestrator/launch/job_script.hpp"
#include "orchestrator/launch/open_jobs.hpp"
#include "orchestrator/launch/slurm_queue.hpp"
#include "orchestrator/stage_state.hpp"

namespace cupola {
namespace {

using nlohmann::json;

std::string own_job() {
  const char* job = std::getenv("SLURM_JOB_ID");
  return job != nullptr ? job : "";
}

/// Stages that are still to be run where the campaign goes to its limit.
int stages_left(const std::vector<json>& journal, Strategy strategy, int episodes) {
  const int each = static_cast<int>(stages_of_episode(strategy).size());
  const int first = strategy == Strategy::predict_and_verify ? 1 : 0;
  return std::max(first + each * episodes - stages_finished(journal), 1);
}

}  // namespace

std::string SlurmChain::open_name() const { return open_jobs(run_.journal().records()).chain; }

std::vector<std::string> SlurmChain::submit(const StageLauncher& launcher, std::optional<int> at_most) {
  const Launch& launch = run_.campaign().launch;
  if (!launch.slurm)
    throw Failure(ExitCode::wrong_input,
                  "--submit needs to know the cluster: give launch: {slurm: {ranks: 64, time: 24 h}} in the campaign.")
        .at("key", "launch.slurm");
  require_none();
  const std::filesystem::path folder = run_.path() / "chain";
  std::filesystem::create_directories(folder);
  std::vector<std::string> words = {(launcher.folder() / "cupola").string(), "resume", run_.path().string(),
                                    "--chain-link"};
  if (at_most) words.insert(words.end(), {"--at-most", std::to_string(*at_most)});
  write_text_atomically(folder / "link.sh", link_script(*launch.slurm, words));

  BatchJob link{job_name(run_, "chain"), folder / "link.sh", folder, folder / "link.log"};
  const int links = stages_left(run_.journal().records(), run_.campaign().strategy,
                                at_most.value_or(run_.campaign().converged.at_most));
  run_.journal().append("chain-submitting", {{"name", link.name}, {"links", links}});
  std::vector<std::string> jobs;
  try {
    for (int i = 0; i < links; ++i) {
      jobs.push_back(SlurmQueue::submit(launch, link));
      link.after = jobs.back();
    }
  } catch (const Failure& failure) {
    SlurmQueue::cancel(jobs);
    run_.journal().append("chain-ended", {{"name", link.name}, {"sentence", failure.what()}});
    throw;
  }
  run_.journal().append("chain-submitted", {{"name", link.name}, {"jobs", jobs}});
  return jobs;
}

void SlurmChain::require_none() const {
  const std::string name = open_name();
  if (name.empty()) return;
  const auto jobs = SlurmQueue::unfinished(name);
  if (!jobs)
    throw Failure(ExitCode::input_output,
                  fmt::format("{}: was submitted as a chain of jobs ({}), and squeue does not say whether it still "
                              "waits or runs. Try where squeue works.",
                              run_.path().string(), name));
  if (jobs->empty() || std::find(jobs->begin(), jobs->end(), own_job()) != jobs->end()) return;
  throw Failure(ExitCode::held,
                fmt::format("{}: works as a chain of jobs in Slurm ({}); wait for it, or take it out of "
                            "the queue first with `scancel --name={}`.",
                            run_.path().string(), fmt::join(*jobs, ", "), name));
}

void SlurmChain::end() {
  const std::string name = open_name();
  if (name.empty()) return;
  run_.journal().append("chain-ended", {{"name", name}});
  std::vector<std::string> rest = SlurmQueue::unfinished(name).value_or(std::vector<std::string>{});
  rest.erase(std::remove(rest.begin(), rest.end(), own_job()), rest.end());
  SlurmQueue::cancel(rest);
}

}  // namespace cupola
