#include "orchestrator/go_on.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include "orchestrator/child_process.hpp"
#include "orchestrator/measured_rates.hpp"
#include "orchestrator/report/report.hpp"
#include "orchestrator/stage_state.hpp"
#include "orchestrator/stage_versions.hpp"
#include "schemas/version.hpp"

namespace cupola {

ExitCode go_on(RunFolder& folder, const MarchOptions& options, SignalWatch& signals) {
  const StageLauncher launcher(StageLauncher::own_folder());
  ProgressView view;
  const int at_most = options.at_most.value_or(folder.campaign().converged.at_most);
  const ProcessIdentity self = ProcessIdentity::of(::getpid());
  folder.journal().append(
      "orchestrator-started",
      {{"host", self.host}, {"pid", self.pid}, {"program_version", program_version}, {"at_most", at_most}});
  settle_versions(folder, present_versions(launcher), options.accept_versions);
  if (options.ranks && *options.ranks != ranks_in_force(folder.journal().records(), folder.campaign().launch.ranks)) {
    if (folder.campaign().launch.slurm)
      throw Failure(ExitCode::wrong_input,
                    "--ranks does not go with launch.slurm, whose jobs ask for the campaign's ranks.");
    folder.journal().append("ranks-changed", {{"ranks", *options.ranks}});
  }
  // A campaign of days does not end because its report cannot be written: that is said, and `cupola report` makes it
  // later.
  const AfterStage renew_report = [&] {
    try {
      remember_rates(make_report(folder.path()));
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

}  // namespace cupola
