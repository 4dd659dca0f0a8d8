#include "orchestrator/run_status.hpp"

#include <fmt/format.h>

#include "orchestrator/progress_view.hpp"
#include "orchestrator/stage_launcher.hpp"
#include "orchestrator/stage_state.hpp"

namespace cupola {
namespace {

using nlohmann::json;

std::string condition_text(StageState::Condition condition) {
  using Condition = StageState::Condition;
  switch (condition) {
    case Condition::absent:
      return "not begun";
    case Condition::interrupted:
      return "interrupted";
    case Condition::running:
      return "running";
    case Condition::failed:
      return "failed";
    case Condition::finished:
      break;
  }
  return "finished";
}

/// The stage the campaign is at: the first that is not finished, else the last one.
struct Present {
  int episode = 1;
  TaskKind kind = TaskKind::dem;
  StageState state;
};

Present present_stage(const RunRecord& run, int at_most) {
  Present present;
  for (int episode = 1; episode <= at_most; ++episode) {
    for (const TaskKind kind : {TaskKind::dem, TaskKind::tracer}) {
      StageState state = stage_state(run.folder, run.journal, episode, kind);
      if (state.condition == StageState::Condition::absent && (episode > 1 || kind == TaskKind::tracer)) return present;
      present = {episode, kind, std::move(state)};
      if (present.state.condition != StageState::Condition::finished) return present;
    }
  }
  return present;
}

const json* last_record(const RunRecord& run, const std::string& event) {
  for (auto record = run.journal.rbegin(); record != run.journal.rend(); ++record)
    if (record->value("event", "") == event) return &*record;
  return nullptr;
}

/// State and sentence of a run nobody works on.
void describe_rest(const RunRecord& run, json& status) {
  const json* last = nullptr;
  for (const json& record : run.journal)
    if (record.value("event", "") != "orchestrator-started") last = &record;
  const std::string event = last != nullptr ? last->value("event", "") : "";
  status["state"] = "stopped";
  if (event == "campaign-ended") status["state"] = last->value("outcome", "ended");
  if (event == "stage-failed") {
    status["state"] = "failed";
    status["message"] = (*last)["failure"].value("sentence", "");
  } else if (event == "result-refused") {
    status["state"] = "failed";
    status["message"] = (*last)["sentence"];
  }
}

}  // namespace

json run_status(const RunRecord& run) {
  int at_most = run.campaign.converged.at_most;
  if (const json* started = last_record(run, "orchestrator-started")) at_most = started->value("at_most", at_most);
  json status = {{"campaign", run.campaign.name},
                 {"folder", run.folder.string()},
                 {"held_by", nullptr},
                 {"message", nullptr},
                 {"at_most", at_most},
                 {"progress", nullptr},
                 {"episodes", json::array()}};
  if (const auto holder = FolderLock::holder(run.folder)) {
    status["state"] = "running";
    status["held_by"] = *holder;
  } else {
    describe_rest(run, status);
  }
  const Present present = present_stage(run, at_most);
  status["episode"] = present.episode;
  status["stage"] = stage_name(present.kind);
  status["attempt"] = present.state.attempt;
  status["condition"] = condition_text(present.state.condition);
  if (const auto progress = read_progress(present.state.folder))
    status["progress"] = read_json(present.state.folder / "progress.json");
  for (const json& record : run.journal)
    if (record.value("event", "") == "episode-judged")
      status["episodes"].push_back(
          {{"index", record["episode"]}, {"change", record["change"]}, {"met", record["met"]}});
  return status;
}

std::string status_text(const json& status) {
  std::string text = fmt::format("{}: {}", status["campaign"].get<std::string>(), status["state"].get<std::string>());
  if (status["held_by"].is_string()) text += " (" + status["held_by"].get<std::string>() + ")";
  if (status["message"].is_string()) text += "\n  " + status["message"].get<std::string>();
  const std::filesystem::path run = status["folder"].get<std::string>();
  const StagePlace place{status["episode"], status["at_most"],
                         status["stage"] == "dem" ? TaskKind::dem : TaskKind::tracer, status["attempt"]};
  const auto progress = read_progress(task_folder(run, place.episode, place.kind, place.attempt));
  const std::string condition = status["condition"].get<std::string>();
  text += "\n  " + (condition == "running" || status["state"] == "running"
                        ? progress_line(place, progress)
                        : fmt::format("episode {} of at most {} · {} · {}", place.episode, place.at_most,
                                      stage_name(place.kind), condition));
  for (const json& episode : status["episodes"]) {
    text += fmt::format("\n  episode {}: change over criterion:", episode["index"].get<int>());
    for (const auto& [rule, change] : episode["change"].items())
      text += fmt::format(" {} {}", rule, change.is_null() ? "-" : fmt::format("{:.3g}", change.get<double>()));
    if (episode["met"].get<bool>()) text += " (met)";
  }
  return text;
}

}  // namespace cupola
