#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>

#include "orchestrator/child_process.hpp"
#include "orchestrator/commands.hpp"
#include "orchestrator/report/report.hpp"
#include "orchestrator/run_check.hpp"
#include "orchestrator/stage_launcher.hpp"
#include "orchestrator/stage_versions.hpp"
#include "physics/plan/plan.hpp"
#include "schemas/campaign_reader.hpp"
#include "schemas/version.hpp"

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

ExitCode go_on(RunFolder& folder, const MarchOptions& options, SignalWatch& signals, const StageLauncher& launcher,
               const nlohmann::json& versions) {
  ProgressView view;
  const int at_most = options.at_most.value_or(folder.campaign().converged.at_most);
  const ProcessIdentity self = ProcessIdentity::of(::getpid());
  folder.journal().append(
      "orchestrator-started",
      {{"host", self.host}, {"pid", self.pid}, {"program_version", program_version}, {"at_most", at_most}});
  settle_versions(folder, versions, options.accept_versions);
  if (options.ranks && *options.ranks != ranks_in_force(folder.journal().records(), folder.campaign().launch.ranks))
    folder.journal().append("ranks-changed", {{"ranks", *options.ranks}});
  // A campaign of days does not end because its report cannot be written: that is said, and `cupola report` makes it
  // later.
  const AfterStage renew_report = [&] {
    try {
      make_report(folder.path());
    } catch (const std::exception& problem) {
      view.say(fmt::format("no report: {}", problem.what()));
    }
  };
  try {
    return march(folder, launcher, signals, view, options, renew_report);
  } catch (const Failure&) {
    renew_report();
    throw;
  }
}

/// A run that cannot be opened since something in it was changed or damaged: what of it is whole is said with it.
std::unique_ptr<RunFolder> open_or_say_what_is_whole(const fs::path& folder) {
  try {
    return RunFolder::open(folder);
  } catch (const Failure& failure) {
    if (failure.code() == ExitCode::held || !fs::exists(folder / "run.json")) throw;
    throw Failure(failure.code(), fmt::format("{} {} `cupola verify {}` looks at everything.", failure.what(),
                                              still_whole(folder), folder.string()));
  }
}

}  // namespace

ExitCode run(const fs::path& campaign_file, const std::optional<fs::path>& folder, const MarchOptions& options) {
  SignalWatch signals;
  const Plan plan = make_plan(load_campaign(campaign_file));
  refuse(plan);
  for (const std::string& warning : plan.warnings) fmt::print("note: {}\n", warning);
  const StageLauncher launcher(StageLauncher::own_folder());
  const nlohmann::json versions = present_versions(launcher);
  const auto opened = RunFolder::for_campaign(campaign_file, folder.value_or(usual_folder(campaign_file)), versions);
  return go_on(*opened, options, signals, launcher, versions);
}

ExitCode resume(const fs::path& folder, const MarchOptions& options) {
  SignalWatch signals;
  const StageLauncher launcher(StageLauncher::own_folder());
  const auto opened = open_or_say_what_is_whole(folder);
  return go_on(*opened, options, signals, launcher, present_versions(launcher));
}

}  // namespace cupola
