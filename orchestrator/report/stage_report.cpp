#include "orchestrator/report/stage_report.hpp"

#include <algorithm>

#include "orchestrator/failure_text.hpp"
#include "schemas/field_file.hpp"
#include "schemas/files.hpp"

namespace cupola {

namespace {

/// What is known of a stage that has not ended.
nlohmann::json summary_of_progress(const std::filesystem::path& folder) {
  const std::optional<Progress> progress = read_progress(folder);
  if (!progress) {
    return nlohmann::json::object();
  }
  nlohmann::json summary = {{"process_seconds", progress->process_seconds},
                            {"process_seconds_total", progress->process_seconds_total},
                            {"wall_seconds", progress->wall_seconds},
                            {"phase", progress->phase}};
  for (const auto& [name, value] : progress->monitored) {
    summary[name] = value;
  }
  return summary;
}

}  // namespace

void read_stage_result(StageReport& stage, const RunRecord& run) {
  try {
    verify_manifest(stage.state.folder);
    const FieldFile file(stage.result(), stage.kind == TaskKind::dem ? "dem-result" : "tracer-result");
    if (file.header().campaign_hash != run.campaign_hash) {
      stage.sentence = stage.result().string() + ": the result of another campaign";
      return;
    }
    stage.summary = file.summary();
    stage.summary["cells"] = file.cells();
    stage.mesh_hash = file.header().mesh_hash;
    stage.readable = true;
  } catch (const Failure& failure) {
    stage.sentence = failure.what();
  }
}

std::string StageReport::state_text() const {
  switch (state.condition) {
    case StageState::Condition::absent:
      return "absent";
    case StageState::Condition::interrupted:
      return "interrupted";
    case StageState::Condition::running:
      return "running";
    case StageState::Condition::failed:
      return "failed";
    case StageState::Condition::finished:
      break;
  }
  return readable ? "finished" : "damaged";
}

std::string shown_name(TaskKind kind) {
  switch (kind) {
    case TaskKind::dem:
      return "DEM";
    case TaskKind::predict:
      return "prediction";
    case TaskKind::correct:
      return "correction";
    default:
      return "tracer";
  }
}

StageReport read_stage_report(const RunRecord& run, int episode, TaskKind kind) {
  StageReport stage;
  stage.episode = episode;
  stage.kind = kind;
  stage.state = stage_state(run.folder, run.journal, episode, kind);
  stage.summary = nlohmann::json::object();
  if (stage.state.condition == StageState::Condition::absent) {
    return stage;
  }
  stage.history = read_history(stage.state.folder);
  const double wall_seconds = wall_seconds_of_stage(run.folder, episode, kind);
  if (stage.state.condition == StageState::Condition::finished) {
    read_stage_result(stage, run);
  } else {
    stage.summary = summary_of_progress(stage.state.folder);
    if (const auto failure = read_failure(stage.state.folder)) {
      stage.sentence = failure_text(*failure);
    }
  }
  // What failed attempts and lost work have cost counts too.
  stage.summary["wall_seconds"] = std::max(stage.summary.value("wall_seconds", 0.), wall_seconds);
  return stage;
}

std::vector<StageReport> read_stage_reports(const RunRecord& run) {
  std::vector<StageReport> stages;
  for (int episode = 1;; ++episode) {
    for (const TaskKind kind : stages_of_episode(run.campaign.strategy)) {
      StageReport stage = read_stage_report(run, episode, kind);
      if (stage.state.condition != StageState::Condition::absent) {
        stages.push_back(std::move(stage));
      } else if (!can_be_left_out(kind)) {
        return stages;
      }
    }
  }
}

}  // namespace cupola
