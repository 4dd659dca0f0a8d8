#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>

#include "orchestrator/child_process.hpp"
#include "orchestrator/commands.hpp"
#include "orchestrator/report/report.hpp"
#include "orchestrator/stage_launcher.hpp"
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

ExitCode go_on(RunFolder& folder, const MarchOptions& options, SignalWatch& signals) {
  const StageLauncher launcher(StageLauncher::own_folder());
  ProgressView view;
  const int at_most = options.at_most.value_or(folder.campaign().converged.at_most);
  const ProcessIdentity self = ProcessIdentity::of(::getpid());
  folder.journal().append(
      "orchestrator-started",
      {{"host", self.host}, {"pid", self.pid}, {"program_version", program_version}, {"at_most", at_most}});
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

}  // namespace

ExitCode run(const fs::path& campaign_file, const std::optional<fs::path>& folder, const MarchOptions& options) {
  SignalWatch signals;
  const Plan plan = make_plan(load_campaign(campaign_file));
  refuse(plan);
  for (const std::string& warning : plan.warnings) fmt::print("note: {}\n", warning);
  const auto opened = RunFolder::for_campaign(campaign_file, folder.value_or(usual_folder(campaign_file)));
  return go_on(*opened, options, signals);
}

ExitCode resume(const fs::path& folder, const MarchOptions& options) {
  SignalWatch signals;
  const auto opened = RunFolder::open(folder);
  return go_on(*opened, options, signals);
}

}  // namespace cupola
