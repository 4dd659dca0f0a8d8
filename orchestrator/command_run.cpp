#include <fmt/format.h>

#include <algorithm>

#include "orchestrator/commands.hpp"
#include "orchestrator/go_on.hpp"
#include "orchestrator/launch/slurm_chain.hpp"
#include "orchestrator/run_check.hpp"
#include "orchestrator/stage_versions.hpp"
#include "physics/plan/plan.hpp"
#include "schemas/campaign_reader.hpp"

namespace cupola {
namespace {

namespace fs = std::filesystem;

/// `runs/<campaign>`, with nothing in the name that would lead elsewhere.
fs::path usual_folder(const fs::path& campaign_file) {
  std::string name = load_campaign(campaign_file).name;
  std::replace(name.begin(), name.end(), '/', '-');
  if (name.empty() || name.front() == '.') name.insert(0, "run");
  return fs::path("runs") / name;
}

/// A run that cannot be opened since something in it was changed or damaged: what of it is whole is said with it.
std::unique_ptr<RunFolder> open_or_say_what_is_whole(const fs::path& folder) {
  try {
    return RunFolder::open(folder);
  } catch (const Failure& failure) {
    if (failure.code() == ExitCode::held || !fs::exists(folder / "run.json")) throw;
    throw Failure(failure.code(), fmt::format("{} `cupola verify {}` looks at everything.",
                                              still_whole(folder, failure.what()), folder.string()));
  }
}

}  // namespace

std::unique_ptr<RunFolder> open_for(const fs::path& campaign_file, const std::optional<fs::path>& folder) {
  const Plan plan = make_plan(load_campaign(campaign_file));
  refuse(plan);
  for (const std::string& warning : plan.warnings) fmt::print("note: {}\n", warning);
  return RunFolder::for_campaign(campaign_file, folder.value_or(usual_folder(campaign_file)),
                                 present_versions(StageLauncher(StageLauncher::own_folder())));
}

ExitCode run(const fs::path& campaign_file, const std::optional<fs::path>& folder, const MarchOptions& options) {
  SignalWatch signals;
  const auto opened = open_for(campaign_file, folder);
  SlurmChain(*opened).require_none();
  return go_on(*opened, options, signals);
}

ExitCode resume(const fs::path& folder, const MarchOptions& options) {
  SignalWatch signals;
  const auto opened = open_or_say_what_is_whole(folder);
  SlurmChain(*opened).require_none();
  return go_on(*opened, options, signals);
}

}  // namespace cupola
