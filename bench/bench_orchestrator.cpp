/// The orchestrator's own share of a campaign's wall time: what it takes beside its stages (hashes, journal, judgement,
/// report) and the processor time it takes while it waits for them; and how long the stages take to their first step.
///   bench_orchestrator [--json FILE] [--campaign FILE | --run RUN]
/// Runs the campaign (cases/tiny without one) in a folder of its own, or reads a run that is there.
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <cstdlib>
#include <iostream>

#include "orchestrator/journal.hpp"
#include "orchestrator/stage_launcher.hpp"
#include "schemas/files.hpp"
#include "tests/support/temporary_folder.hpp"

int main(int argc, char** argv) {
  CLI::App app("The orchestrator's own share of a campaign's wall time");
  std::string json_file, campaign = CUPOLA_SOURCE_DIR "/cases/tiny/campaign.yaml", run;
  app.add_option("--json", json_file, "a file for the figures");
  app.add_option("--campaign", campaign, "the campaign to run");
  app.add_option("--run", run, "a run that is there");
  CLI11_PARSE(app, argc, argv);

  const cupola::TemporaryFolder folder;
  if (run.empty()) {
    run = (folder.path() / "run").string();
    const std::string command =
        fmt::format("'{}' run '{}' --run-dir '{}' > '{}'", (cupola::StageLauncher::own_folder() / "cupola").string(),
                    campaign, run, (folder.path() / "output").string());
    std::system(command.c_str());  // the journal says how it ended
  }
  double own = 0;
  double processor = 0;
  double all = 0;
  for (const nlohmann::json& record : cupola::read_journal(std::filesystem::path(run) / "journal.jsonl")) {
    if (!record.contains("own")) continue;
    own += record["own"]["wall_seconds"].get<double>();
    processor += record["own"]["cpu_seconds"].get<double>();
    all += record["own"]["of_wall_seconds"].get<double>();
  }
  if (all == 0) {
    std::cerr << run << ": no start of the orchestrator has ended well\n";
    return 1;
  }
  fmt::print("orchestrator: {:.3g} s of {:.4g} s wall time its own ({:.2f} %), {:.3g} s of processor time ({:.2f} %)\n",
             own, all, 100 * own / all, processor, 100 * processor / all);
  // From the start of a stage's process to its first step.
  std::map<std::string, double> start_up;
  const nlohmann::json report = cupola::read_json(std::filesystem::path(run) / "report/report.json");
  const nlohmann::json::json_pointer part("/wall_seconds_by_part/start-up");
  for (const nlohmann::json& episode : report.at("episodes"))
    for (const char* stage : {"dem", "tracer"})
      if (episode.contains(stage) && episode[stage].contains(part))
        start_up[stage] = std::max(start_up[stage], episode[stage][part].get<double>());
  for (const auto& [stage, seconds] : start_up) fmt::print("{} stage: first step after {:.2f} s\n", stage, seconds);
  if (json_file.empty()) return 0;
  nlohmann::json figures = nlohmann::json::array();
  const auto figure = [&](const char* metric, double value, const char* unit) {
    figures.push_back({{"bench", "orchestrator"},
                       {"setting", std::filesystem::path(campaign).parent_path().filename().string()},
                       {"metric", metric},
                       {"value", value},
                       {"unit", unit}});
  };
  figure("own wall time", 100 * own / all, "%");
  figure("own processor time", 100 * processor / all, "%");
  for (const auto& [stage, seconds] : start_up) figure((stage + " start-up").c_str(), seconds, "s");
  cupola::write_json_atomically(json_file, figures);
}
