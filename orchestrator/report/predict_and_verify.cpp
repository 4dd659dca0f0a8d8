#include "orchestrator/report/predict_and_verify.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "orchestrator/report/answers.hpp"
#include "orchestrator/report/json_numbers.hpp"

namespace cupola {
namespace {

using nlohmann::json;

/// One line of what was done.
json step(int episode, const std::string& what, const json& stage) {
  return {{"episode", episode},
          {"what", what},
          {"state", stage.value("state", "finished")},
          {"mean_solid_temperature", number_or_null(stage, "/mean_solid_temperature")},
          {"cohesive_zone_height", number_or_null(stage, "/cohesive_zone/height_mean")},
          {"wall_seconds", number_or_null(stage, "/wall_seconds")},
          {"marched_seconds", 0},
          {"changed", nullptr},
          {"sentence", ""}};
}

/// What a judgement of the journal says; null where there is none.
json judgement_of(const RunRecord& run, int episode) {
  json judgement;
  for (const json& record : run.journal)
    if (record.value("event", "") == "episode-judged" && record.value("episode", 0) == episode) judgement = record;
  return judgement;
}

void add_episode(const RunRecord& run, const json& episode, json& steps) {
  const int index = episode.at("index");
  steps.push_back(step(index, "DEM stage", episode.at("dem")));
  if (episode.at("predict").is_object()) {
    json line = step(index, "prediction with its field", episode.at("predict"));
    if (line.at("state") == "finished" &&
        !episode.at("predict").value(json::json_pointer("/prediction/converged"), false))
      line["sentence"] = "It did not converge: the tracers marched instead.";
    steps.push_back(line);
  }
  if (!episode.at("tracer").is_object()) return;
  json line = step(index, "tracers marched", episode.at("tracer"));
  line["marched_seconds"] = number_or_null(episode.at("tracer"), "/process_seconds");
  const json& correction = episode.at("correct");
  if (const auto apart = number_at(correction, "/correction/from_prediction")) {
    line["changed"] = *apart;
    line["sentence"] = fmt::format("Left alone, they went {} from the prediction they began with ({} of it noise).",
                                   percent(*apart), percent(number_at(correction, "/correction/noise").value_or(0)));
  }
  steps.push_back(line);
  if (!correction.is_object()) return;
  line = step(index, "corrected prediction", correction);
  const json judgement = judgement_of(run, index);
  if (const auto jump = number_at(judgement, "/remaining_error/jump")) {
    line["changed"] = *jump;
    line["sentence"] = fmt::format(
        "{} from what the DEM stage softened by; the tracers had {} to go, and the streamlines leave out {}.",
        percent(*jump), percent(number_at(judgement, "/remaining_error/to_go").value_or(0)),
        percent(number_at(correction, "/correction/bias").value_or(0)));
  }
  steps.push_back(line);
}

}  // namespace

json predict_and_verify(const RunRecord& run, const json& report) {
  if (run.campaign.strategy != Strategy::predict_and_verify) return nullptr;
  json steps = json::array();
  if (const json& first = report.at("prediction"); first.is_object()) {
    json line = step(0, "first prediction, potential flow", first);
    line["state"] = "finished";
    if (!first.value("converged", false))
      line["sentence"] = "It did not converge: the first DEM stage softens by the guess.";
    steps.push_back(line);
  }
  double marched = 0, saved = 0;
  int dem_stages = 0;
  json remaining = nullptr;
  for (const json& episode : report.at("episodes")) {
    add_episode(run, episode, steps);
    ++dem_stages;
    const double hours = number_at(episode, "/tracer/process_seconds").value_or(0);
    marched += hours;
    if (episode.at("tracer").is_object()) saved += std::max(0., run.campaign.tracer.duration - hours);
    const json judgement = judgement_of(run, episode.at("index"));
    if (judgement.is_object() && judgement.contains("remaining_error")) remaining = judgement.at("remaining_error");
  }
  std::string sentence =
      fmt::format("{} DEM stage{}, {} of process time marched; {} of tracer.duration were not marched.", dem_stages,
                  dem_stages == 1 ? "" : "s", duration_in_words(marched), duration_in_words(saved));
  if (const auto estimate = number_at(remaining, "/estimate"))
    sentence += fmt::format(
        " The temperatures are estimated to be off by at most {}: {} times the rms of what the last DEM stage changed, "
        "what the tracers had still to go, and their noise.",
        percent(*estimate), number_at(remaining, "/safety").value_or(1));
  return {{"windows", run.campaign.predict_and_verify.windows},
          {"marched_seconds", marched},
          {"saved_seconds", saved},
          {"dem_stages", dem_stages},
          {"remaining_error", remaining},
          {"sentence", sentence},
          {"steps", steps}};
}

}  // namespace cupola
