#include "orchestrator/stage_state.hpp"

#include <algorithm>

#include "orchestrator/run_folder.hpp"
#include "orchestrator/stage_launcher.hpp"
#include "schemas/files.hpp"

namespace cupola {
namespace {

using nlohmann::json;

int latest_attempt(const std::filesystem::path& run, int episode, TaskKind kind) {
  int attempt = 0;
  while (std::filesystem::is_directory(task_folder(run, episode, kind, attempt + 1))) ++attempt;
  return attempt;
}

std::optional<ProcessIdentity> started_process(const std::vector<json>& journal, int episode, TaskKind kind,
                                               int attempt) {
  const json* record = last_record(journal, "stage-started", episode, kind, attempt);
  if (record == nullptr) return std::nullopt;
  return ProcessIdentity{record->value("host", ""), record->value("pid", 0),
                         record->value("process_started", std::uint64_t{0})};
}

}  // namespace

bool is_about(const json& record, int episode, TaskKind kind, int attempt) {
  return record.value("episode", 0) == episode && record.value("stage", "") == stage_name(kind) &&
         record.value("attempt", 0) == attempt;
}

StageState stage_state(const std::filesystem::path& run, const std::vector<json>& journal, int episode, TaskKind kind) {
  StageState state;
  const int attempt = latest_attempt(run, episode, kind);
  state.attempt = std::max(attempt, 1);
  state.folder = task_folder(run, episode, kind, state.attempt);
  if (const json* record = last_record(journal, "stage-finished", episode, kind, state.attempt))
    state.finished_record = *record;
  if (attempt == 0) return state;
  const auto process = started_process(journal, episode, kind, attempt);
  const bool process_lives = process && process->alive();
  if (process_lives || FolderLock::holder(state.folder)) {
    state.condition = StageState::Condition::running;
    if (process_lives) state.process = process;
    return state;
  }
  if (has_manifest(state.folder)) {
    state.condition = StageState::Condition::finished;
    return state;
  }
  state.condition = StageState::Condition::interrupted;
  if (auto failure = read_failure(state.folder);
      failure && failure->value("code", 0) == static_cast<int>(ExitCode::diverged)) {
    state.condition = StageState::Condition::failed;
    state.failure = std::move(failure);
  }
  return state;
}

const json* last_record(const std::vector<json>& journal, const std::string& event, int episode, TaskKind kind,
                        int attempt) {
  for (auto record = journal.rbegin(); record != journal.rend(); ++record) {
    if (!is_about(*record, episode, kind, attempt)) continue;
    const std::string found = record->value("event", "");
    if (found == event) return &*record;
    if (found == "stage-begun-anew") return nullptr;
  }
  return nullptr;
}

int stages_finished(const std::vector<json>& journal) {
  return static_cast<int>(std::count_if(journal.begin(), journal.end(), [](const json& record) {
    return record.value("event", "") == "stage-finished";
  }));
}

int ranks_in_force(const std::vector<json>& journal, int of_campaign) {
  int ranks = of_campaign;
  for (const json& record : journal)
    if (record.value("event", "") == "ranks-changed") ranks = record.value("ranks", ranks);
  return ranks;
}

double wall_seconds_of_stage(const std::filesystem::path& run, int episode, TaskKind kind) {
  double sum = 0;
  for (int attempt = 1; attempt <= latest_attempt(run, episode, kind); ++attempt)
    if (const auto progress = read_progress(task_folder(run, episode, kind, attempt))) sum += progress->wall_seconds;
  return sum;
}

std::vector<std::pair<std::string, std::string>> advice_taken(const std::vector<json>& journal) {
  std::vector<std::pair<std::string, std::string>> changes;
  for (const json& record : journal)
    if (record.value("event", "") == "advice-taken")
      for (const auto& [key, value] : record["changes"].items()) changes.emplace_back(key, value.get<std::string>());
  return changes;
}

}  // namespace cupola
