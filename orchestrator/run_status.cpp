#include "orchestrator/run_status.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <fstream>
#include <set>

#include "orchestrator/failure_text.hpp"
#include "orchestrator/launch/open_jobs.hpp"
#include "orchestrator/launch/slurm_queue.hpp"
#include "orchestrator/measured_rates.hpp"
#include "orchestrator/progress_view.hpp"
#include "orchestrator/quantity_text.hpp"
#include "orchestrator/remaining_time.hpp"
#include "orchestrator/stage_launcher.hpp"
#include "orchestrator/stage_state.hpp"
#include "physics/plan/plan.hpp"

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
  using Condition = StageState::Condition;
  Present present;
  if (run.campaign.strategy == Strategy::predict_and_verify) {
    present = {before_all_episodes, TaskKind::predict,
               stage_state(run.folder, run.journal, before_all_episodes, TaskKind::predict)};
    if (present.state.condition != Condition::finished && present.state.condition != Condition::failed) return present;
  }
  for (int episode = 1; episode <= at_most; ++episode) {
    for (const TaskKind kind : stages_of_episode(run.campaign.strategy)) {
      StageState state = stage_state(run.folder, run.journal, episode, kind);
      if (state.condition == Condition::absent && can_be_left_out(kind)) continue;
      if (state.condition == Condition::absent && (episode > 1 || kind != TaskKind::dem)) return present;
      present = {episode, kind, std::move(state)};
      if (present.state.condition == Condition::failed && can_be_left_out(kind)) continue;
      if (present.state.condition != Condition::finished) return present;
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
    status["message"] = failure_text((*last)["failure"]);
  } else if (event == "result-refused") {
    status["state"] = "failed";
    status["message"] = (*last)["sentence"];
  }
}

/// The job of the present stage, or of a chain, that the journal has not seen end, as Slurm sees it where it can be
/// asked.
json present_job(const RunRecord& run) {
  const OpenJobs open = open_jobs(run.journal);
  std::string job = open.job;
  if (job.empty() && !open.chain.empty()) {
    const auto links = SlurmQueue::unfinished(open.chain);
    if (links && !links->empty()) job = links->front();
  }
  if (job.empty()) return nullptr;
  const JobState state = SlurmQueue::state(job);
  return {{"number", job},
          {"state", state.word.empty() ? json() : json(state.word)},
          {"reason", state.reason},
          {"over", state.phase == JobState::Phase::ended || state.phase == JobState::Phase::forgotten}};
}

/// The last line of a stage's history that knows a quantity; stages backwards from the present one.
json last_known(const RunRecord& run, const Present& present, const std::string& quantity) {
  for (int episode = present.episode; episode >= 1; --episode) {
    const StageState state = stage_state(run.folder, run.journal, episode, TaskKind::tracer);
    if (state.condition == StageState::Condition::absent) continue;
    const auto history = read_history(state.folder);
    for (auto line = history.rbegin(); line != history.rend(); ++line)
      if (line->contains(quantity) && (*line)[quantity].is_number()) return (*line)[quantity];
  }
  return nullptr;
}

/// Wall time of the finished stages of one kind, mean; 0 where there is none.
double mean_wall_seconds(const RunRecord& run, TaskKind kind) {
  double sum = 0;
  int stages = 0;
  for (const json& record : run.journal) {
    if (record.value("event", "") != "stage-finished" || record.value("stage", "") != stage_name(kind)) continue;
    const auto progress =
        read_progress(task_folder(run.folder, record.value("episode", 0), kind, record.value("attempt", 1)));
    if (!progress) continue;
    sum += progress->wall_seconds;
    ++stages;
  }
  return stages > 0 ? sum / stages : 0;
}

/// Cost of the campaign on the ranks that it has now, by the plan and the rates of this machine; none where the plan
/// cannot be made.
std::optional<Cost> cost_in_force(const RunRecord& run) {
  try {
    Campaign campaign = run.campaign;
    campaign.launch.ranks = ranks_in_force(run.journal, campaign.launch.ranks);
    return make_plan(campaign, measured_rates()).cost;
  } catch (const Failure&) {
    return std::nullopt;
  }
}

/// Rest of the present stage, of its episode and of the episodes after it, by the trend of convergence.
json remaining(const RunRecord& run, const Present& present, int at_most) {
  std::vector<json> judged;
  for (const json& record : run.journal)
    if (record.value("event", "") == "episode-judged") judged.push_back(record);
  const auto trend = remaining_episodes(judged, run.campaign.converged, at_most);
  // Before there is a trend: all that the limit leaves.
  const int episodes = trend ? trend->episodes : std::max(at_most - static_cast<int>(judged.size()), 0);
  json result = {{"episodes", episodes},
                 {"seconds", nullptr},
                 {"by_expectation", false},
                 {"until_limit", !trend || trend->until_limit},
                 {"why", trend ? trend->why : "a trend is known after two episodes"}};
  // Wall time of an episode, and of its stages before the present one.
  double whole = 0, before = 0, present_one = 0;
  std::optional<Cost> expected;
  for (const TaskKind kind : stages_of_episode(run.campaign.strategy)) {
    double stage = mean_wall_seconds(run, kind);
    if (stage <= 0 && !can_be_left_out(kind)) {
      if (!expected) expected = cost_in_force(run);
      if (!expected) return result;
      stage = kind == TaskKind::dem ? expected->dem_wall_seconds() : expected->tracer_wall_seconds();
      if (stage <= 0) return result;
      result["by_expectation"] = true;
    }
    if (kind == present.kind) {
      before = whole;
      present_one = stage;
    }
    whole += stage;
  }
  double seconds = episodes * whole;
  // What of the present episode has been done already.
  if (present.episode > static_cast<int>(judged.size()) && episodes > 0) {
    const auto progress = read_progress(present.state.folder);
    const double share = progress && progress->process_seconds_total > 0
                             ? std::min(progress->process_seconds / progress->process_seconds_total, 1.0)
                             : 0.0;
    seconds -= before + share * present_one;
  }
  result["seconds"] = std::max(seconds, 0.0);
  return result;
}

/// Lines of warning at the end of a stage's log, without their time.
std::vector<std::string> logged_warnings(const std::filesystem::path& log) {
  constexpr std::uintmax_t end_read = 65536;
  std::vector<std::string> warnings;
  std::ifstream file(log);
  if (!file) return warnings;
  std::error_code ignored;
  if (const auto size = std::filesystem::file_size(log, ignored); size > end_read && !ignored)
    file.seekg(static_cast<std::streamoff>(size - end_read));
  for (std::string line; std::getline(file, line);)
    for (const char* level : {" warning: ", " error: "})
      if (const auto at = line.find(level); at != std::string::npos && at < 30) {
        std::string said = line.substr(at + std::string(level).size());
        if (!said.starts_with("  ")) warnings.push_back(std::move(said));  // its place and advice stand in the message
      }
  return warnings;
}

/// The last things that went otherwise than planned, newest last.
std::vector<std::string> last_warnings(const RunRecord& run, const Present& present) {
  constexpr std::size_t most = 3;
  std::vector<std::string> warnings;
  for (const json& record : run.journal) {
    const std::string event = record.value("event", "");
    const std::string place =
        fmt::format("{} stage of episode {}", record.value("stage", ""), record.value("episode", 0));
    if (event == "stage-failed" && record.contains("failure"))
      warnings.push_back(place + ": " + failure_text(record["failure"]));
    if (event == "stage-died") warnings.push_back(place + " ended without saying why and was started again");
    if (event == "result-refused") warnings.push_back(place + ": " + record.value("sentence", ""));
    if (event == "advice-taken") warnings.push_back(place + " was tried again: " + record.value("because", ""));
    if (event == "stage-stopped" && record.contains("why")) warnings.push_back(place + ": " + record.value("why", ""));
  }
  // A stage that is started again says the same again.
  std::set<std::string> said;
  for (const std::string& line : logged_warnings(present.state.folder / "stage.log"))
    if (said.insert(line).second)
      warnings.push_back(fmt::format("{}: {}", stage_title(present.kind, present.episode), line));
  if (warnings.size() > most) warnings.erase(warnings.begin(), warnings.end() - most);
  return warnings;
}

std::string remaining_text(const json& remaining) {
  const int episodes = remaining["episodes"];
  std::string text = remaining["until_limit"].get<bool>()
                         ? fmt::format("at most {} more episode{}, to the limit", episodes, episodes == 1 ? "" : "s")
                         : fmt::format("{} more episode{} by the trend", episodes, episodes == 1 ? "" : "s");
  if (remaining["seconds"].is_number())
    text += fmt::format(", about {}{}", duration_text(remaining["seconds"].get<double>()),
                        remaining["by_expectation"].get<bool>() ? " at the rates expected here" : "");
  return "\n  to go: " + text + " (" + remaining["why"].get<std::string>() + ")";
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
                 {"job", present_job(run)},
                 {"records", run.journal.size()},
                 {"episodes", json::array()}};
  const bool has_job = status["job"].is_object() && !status["job"].value("over", false);
  if (const auto holder = FolderLock::holder(run.folder)) {
    status["state"] = "running";
    status["held_by"] = *holder;
  } else {
    describe_rest(run, status);
    if (has_job) status["state"] = status["job"]["state"] == "PENDING" ? "queued" : "running";
  }
  const Present present = present_stage(run, at_most);
  status["episode"] = present.episode;
  status["stage"] = stage_name(present.kind);
  status["attempt"] = present.state.attempt;
  status["condition"] = condition_text(present.state.condition);
  if (const auto progress = read_progress(present.state.folder))
    status["progress"] = read_json(present.state.folder / "progress.json");
  for (const char* quantity : {"mean_solid_temperature", "cohesive_zone_height"})
    status[quantity] = last_known(run, present, quantity);
  status["remaining"] = remaining(run, present, at_most);
  status["warnings"] = last_warnings(run, present);
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
  const StagePlace place{status["episode"], status["at_most"], stage_kind(status["stage"].get<std::string>()),
                         status["attempt"]};
  const auto progress = read_progress(task_folder(run, place.episode, place.kind, place.attempt));
  const std::string condition = status["condition"].get<std::string>();
  text += "\n  " + (condition == "running" || status["state"] == "running"
                        ? progress_line(place, progress)
                        : fmt::format("episode {} of at most {} · {} · {}", place.episode, place.at_most,
                                      stage_name(place.kind), condition));
  if (status["job"].is_object())
    text += fmt::format("\n  job {}: {} {}", status["job"]["number"].get<std::string>(),
                        status["job"]["state"].is_string() ? status["job"]["state"].get<std::string>() : "not known",
                        status["job"]["reason"].get<std::string>());
  std::string known;
  for (const char* quantity : {"mean_solid_temperature", "cohesive_zone_height"})
    if (status[quantity].is_number())
      known += (known.empty() ? "" : " · ") + monitored_text(quantity, status[quantity].get<double>());
  if (!known.empty()) text += "\n  last known: " + known;
  if (status["state"] == "running" || status["state"] == "queued" || status["state"] == "stopped")
    text += remaining_text(status["remaining"]);
  for (const json& episode : status["episodes"]) {
    text += fmt::format("\n  episode {}: change over criterion:", episode["index"].get<int>());
    for (const auto& [rule, change] : episode["change"].items())
      text += fmt::format(" {} {}", rule, change.is_null() ? "-" : fmt::format("{:.3g}", change.get<double>()));
    if (episode["met"].get<bool>()) text += " (met)";
  }
  for (const json& warning : status["warnings"]) text += "\n  note: " + warning.get<std::string>();
  return text;
}

}  // namespace cupola
