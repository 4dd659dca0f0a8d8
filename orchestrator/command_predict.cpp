#include <fmt/format.h>

#include "orchestrator/commands.hpp"
#include "orchestrator/go_on.hpp"
#include "orchestrator/prediction.hpp"
#include "orchestrator/report/report.hpp"
#include "orchestrator/stage_launcher.hpp"

namespace cupola {

ExitCode predict(const std::filesystem::path& campaign_file, const std::optional<std::filesystem::path>& folder) {
  SignalWatch signals;
  const auto run = open_for(campaign_file, folder);
  const StageLauncher launcher(StageLauncher::own_folder());
  if (!finish_prediction(*run, launcher, signals)) {
    fmt::print("stopped; the same command begins the prediction again.\n");
    return ExitCode::stopped;
  }
  const nlohmann::json report = make_report(run->path());
  for (const auto& warning : report.at("prediction").at("warnings"))
    fmt::print("note: {}\n", warning.get<std::string>());
  fmt::print("{}: {}\n{}\n", report.at("campaign").get<std::string>(),
             report.at("answers").at("state_of_the_bed").at("answer").get<std::string>(),
             report.at("answers").at("certainty").at("answer").get<std::string>());
  return report.at("prediction").at("converged").get<bool>() ? ExitCode::done : ExitCode::stopped;
}

}  // namespace cupola
