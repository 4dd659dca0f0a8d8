#include "orchestrator/report/report.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "orchestrator/launch/open_jobs.hpp"
#include "orchestrator/quantity_text.hpp"
#include "orchestrator/report/accuracy.hpp"
#include "orchestrator/report/answers.hpp"
#include "orchestrator/report/charts.hpp"
#include "orchestrator/report/json_numbers.hpp"
#include "orchestrator/report/paraview_views.hpp"
#include "orchestrator/report/predict_and_verify.hpp"
#include "orchestrator/report/prediction_report.hpp"
#include "orchestrator/report/provenance.hpp"
#include "orchestrator/report/report_page.hpp"
#include "orchestrator/report/stage_report.hpp"
#include "orchestrator/report/warnings.hpp"
#include "orchestrator/run_folder.hpp"
#include "orchestrator/stage_sequence.hpp"
#include "physics/plan/scene_warnings.hpp"
#include "schemas/campaign_words.hpp"
#include "schemas/files.hpp"

namespace cupola {

using nlohmann::json;

namespace {

/// The stage's part of `episodes[]`: its summary with what the orchestrator knows beside it.
json stage_entry(const StageReport& stage) {
  json entry = stage.summary;
  entry["state"] = stage.state_text();
  entry["attempts"] = stage.state.attempt;
  if (stage.kind == TaskKind::tracer) {
    entry["mass_residual"] = number_or_null(entry, "/ledger/mass/residual");
    entry["energy_residual"] = number_or_null(entry, "/ledger/energy/residual");
  }
  return entry;
}

/// The journal's judgement of an episode, its parts null by rule where there is none yet.
json judgement_by_rule(const RunRecord& run, int episode) {
  json judgement = {{"change", {{"temperature", nullptr}, {"cohesive_zone", nullptr}, {"granular_velocity", nullptr}}},
                    {"figure", json::object()},
                    {"lambda", json::object()}};
  for (const json& record : run.journal) {
    if (record.value("event", "") == "episode-judged" && record.value("episode", 0) == episode) {
      judgement.merge_patch(
          {{"figure", record.value("figure", json::object())}, {"lambda", record.value("lambda", json::object())}});
      judgement["change"].update(record.value("change", json::object()));
    }
  }
  return judgement;
}

json episodes_of(const RunRecord& run, const std::vector<StageReport>& stages) {
  json episodes = json::array();
  for (const StageReport& stage : stages) {
    if (stage.kind == TaskKind::dem) {
      const json judgement = judgement_by_rule(run, stage.episode);
      episodes.push_back({{"index", stage.episode},
                          {"dem", stage_entry(stage)},
                          {"tracer", nullptr},
                          {"predict", nullptr},
                          {"correct", nullptr},
                          {"mean_solid_temperature", nullptr},
                          {"cohesive_zone", nullptr},
                          {"change", judgement["change"]},
                          {"figures", judgement["figure"]},
                          {"lambda", judgement["lambda"]}});
      continue;
    }
    json& episode = episodes.back();
    episode[stage_name(stage.kind)] = stage_entry(stage);
    // What counts is what the tracers came to, and after that the prediction that they have corrected.
    if (stage.readable && stage.kind != TaskKind::predict) {
      episode["mean_solid_temperature"] = number_or_null(stage.summary, "/mean_solid_temperature");
      episode["cohesive_zone"] = stage.summary.value("cohesive_zone", json());
    }
  }
  return episodes;
}

/// The worst of all finished tracer stages; `clamps`: how often limits of the model were met in all.
json ledger_of(const json& episodes) {
  json ledger = {{"mass_residual", nullptr}, {"energy_residual", nullptr}, {"clamps", 0}};
  double clamps = 0;
  for (const json& episode : episodes) {
    for (const char* residual : {"mass_residual", "energy_residual"}) {
      if (const auto value = number_at(episode, std::string("/tracer/") + residual)) {
        ledger[residual] = std::max(ledger[residual].is_null() ? 0. : ledger[residual].get<double>(), std::abs(*value));
      }
    }
    const json::json_pointer place("/tracer/clamps");
    if (episode.contains(place) && episode.at(place).is_object()) {
      for (const auto& [name, number] : episode.at(place).items()) {
        clamps += number.is_number() ? number.get<double>() : 0.;
      }
    }
  }
  ledger["clamps"] = clamps;
  return ledger;
}

json results_of(const std::vector<StageReport>& stages) {
  json results = json::array();
  for (const StageReport& stage : stages) {
    const json record = stage.state.finished_record.value_or(json::object());
    results.push_back({{"episode", stage.episode},
                       {"stage", shown_name(stage.kind)},
                       {"attempt", stage.state.attempt},
                       {"state", stage.state_text()},
                       {"sentence", stage.sentence},
                       {"file_hash", record.contains("result_hash") ? record["result_hash"] : json()}});
  }
  return results;
}

json retries_of(const RunRecord& run) {
  json retries = json::array();
  for (const json& record : run.journal) {
    if (record.value("event", "") == "advice-taken") {
      std::string changes;
      const json changed_keys = record.value("changes", json::object());
      for (const auto& [key, value] : changed_keys.items()) {
        changes += fmt::format("{}{} = {}", changes.empty() ? " with " : ", ", key,
                               value.is_string() ? value.get<std::string>() : value.dump());
      }
      retries.push_back(fmt::format("The {} stage of episode {} went wrong and was tried again{}: {}",
                                    record.value("stage", "?"), record.value("episode", 0), changes,
                                    record.value("because", "no reason given")));
    }
  }
  return retries;
}

/// State and its sentence.
std::pair<std::string, std::string> state_of(const RunRecord& run, const std::vector<StageReport>& stages) {
  const json last = run.journal.empty() ? json::object() : run.journal.back();
  if (last.value("event", "") == "campaign-ended") {
    const std::string outcome = last.value("outcome", "");
    return {outcome == "not yet converged" ? "not converged at its limit" : outcome,
            counted(last.value("episodes", 0), "episode")};
  }
  if (last.value("event", "") == "result-refused") {
    return {"failed", last.value("sentence", "a result failed its checks")};
  }
  if (stages.empty()) {
    const bool predicting =
        run.campaign.strategy == Strategy::predict_and_verify && FolderLock::holder(run.folder).has_value();
    return predicting ? std::pair{std::string("running"), std::string("in the first prediction")}
                      : std::pair{std::string("not started"), std::string("no stage has begun")};
  }
  const StageReport& stage = stages.back();
  const std::string place = fmt::format("{} stage of episode {}", shown_name(stage.kind), stage.episode);
  const std::string shown = stage.state_text();
  if (shown == "failed" || shown == "damaged") {
    return {"failed", fmt::format("{}: {}", place, stage.sentence)};
  }
  // An orchestrator that stops says so while it still holds the folder; one that was killed holds it no more.
  const bool worked_at =
      last.value("event", "") != "orchestrator-stopped" && FolderLock::holder(run.folder).has_value();
  std::string where = shown == "finished" ? place + " has ended" : "in the " + place;
  const auto done = number_at(stage.summary, "/process_seconds");
  const auto total = number_at(stage.summary, "/process_seconds_total");
  if (!stage.readable && done && total && *total > 0) {
    where += fmt::format(", {:.0f} % of its process time", 100 * *done / *total);
  }
  if (!worked_at && open_jobs(run.journal).any()) {
    return {"queued", fmt::format("{}; its jobs are left to Slurm", where)};
  }
  return worked_at ? std::pair{std::string("running"), where}
                   : std::pair{std::string("stopped"), fmt::format("{}; cupola resume goes on", where)};
}

/// The limit of episodes in force: that of the last start, which may have been given another one.
int episode_limit(const RunRecord& run) {
  int limit = run.campaign.converged.at_most;
  for (const json& record : run.journal) {
    if (record.value("event", "") == "orchestrator-started") {
      limit = record.value("at_most", limit);
    }
  }
  return limit;
}

double wall_seconds_of(const json& episodes) {
  double sum = 0;
  for (const json& episode : episodes) {
    for (const TaskKind kind : all_stages_of_episode())
      sum += number_at(episode, fmt::format("/{}/wall_seconds", stage_name(kind))).value_or(0);
  }
  return sum;
}

json gather(const RunRecord& run, const std::vector<StageReport>& stages) {
  const Campaign& campaign = run.campaign;
  const std::optional<StageReport> prediction = read_prediction_report(run);
  const auto [state, description] =
      stages.empty() && prediction && campaign.strategy == Strategy::march
          ? std::pair{std::string("predicted"), std::string("a prediction; no stage was run")}
          : state_of(run, stages);
  // What is drawn of tracer stages is drawn of the prediction too, as episode 0.
  std::vector<StageReport> drawn = stages;
  if (prediction) drawn.insert(drawn.begin(), *prediction);
  const json information = run.information;
  const auto readable =
      std::find_if(drawn.rbegin(), drawn.rend(), [](const StageReport& stage) { return stage.readable; });
  json report = {{"schema", 1},
                 {"campaign", campaign.name},
                 {"state", state},
                 {"description", description},
                 {"converged", state == "converged"},
                 {"has_heat", campaign.heat.has_value()},
                 {"random_seed", campaign.random_seed},
                 {"versions", information.value("versions", json::object())},
                 {"host", information.value("host", "")},
                 {"started", information.value("started", "")},
                 {"file_written", utc_now()},
                 {"run_folder", run.folder.filename().string()},
                 {"campaign_hash", run.campaign_hash},
                 {"mesh_hash", readable == drawn.rend() ? "" : readable->mesh_hash},
                 {"criteria",
                  {{"temperature", campaign.converged.temperature},
                   {"cohesive_zone", campaign.converged.cohesive_zone_cells},
                   {"granular_velocity", campaign.converged.granular_velocity_sigma},
                   {"for", campaign.converged.for_episodes},
                   {"at_most", episode_limit(run)}}},
                 {"furnace", furnace_drawing(campaign)},
                 {"prediction", prediction_entry(prediction)},
                 {"strategy", std::string(words::word_of(words::strategy, campaign.strategy))},
                 {"episodes", episodes_of(run, stages)},
                 {"results", results_of(stages)},
                 {"retries", retries_of(run)},
                 {"campaign_text", read_text(run.folder / "campaign.yaml")}};
  report["wall_seconds"] =
      wall_seconds_of(report["episodes"]) + number_at(report["prediction"], "/wall_seconds").value_or(0);
  report["ledger"] = ledger_of(report["episodes"]);
  report["predict_and_verify"] = predict_and_verify(run, report);
  report["charts"] = {{"dem_history", dem_history(stages)},
                      {"tracer_history", tracer_history(stages)},
                      {"cohesive_zones", cohesive_zones(drawn)},
                      {"maps", field_maps(drawn, campaign)}};
  report["accuracy"] = accuracy_and_cost(stages, report);
  report["provenance"] = provenance(run, stages);
  std::vector<std::string> told = scene_warnings(campaign);
  for (std::string& warning : warnings(report)) told.push_back(std::move(warning));
  report["warnings"] = told;
  report["answers"] = answers(report);
  return report;
}

}  // namespace

json gather_report(const std::filesystem::path& run_folder) {
  const RunRecord run = read_run(run_folder);
  return gather(run, read_stage_reports(run));
}

json make_report(const std::filesystem::path& run_folder) {
  const RunRecord run = read_run(run_folder);
  const std::vector<StageReport> stages = read_stage_reports(run);
  json report = gather(run, stages);
  const std::filesystem::path folder = run_folder / "report";
  std::error_code error;
  std::filesystem::create_directories(folder, error);
  if (error) {
    throw Failure(ExitCode::input_output, fmt::format("{}: cannot be made: {}", folder.string(), error.message()));
  }
  write_sealed_json(folder / "report.json", report);
  write_text_atomically(folder / "index.html", report_page(report));
  write_paraview_views(run.folder, stages);
  write_json_atomically(run_folder / "ro-crate-metadata.json", ro_crate(run, report));
  return report;
}

}  // namespace cupola
