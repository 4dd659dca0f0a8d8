#include "orchestrator/study/finished_stage.hpp"

#include "orchestrator/run_folder.hpp"
#include "orchestrator/stage_state.hpp"

namespace cupola {

std::optional<std::filesystem::path> last_finished_stage(const std::filesystem::path& run_folder, TaskKind kind) {
  const RunRecord run = read_run(run_folder);
  std::optional<std::filesystem::path> last;
  for (int episode = 1; std::filesystem::exists(stage_folder(run.folder, episode, kind)); ++episode) {
    const StageState state = stage_state(run.folder, run.journal, episode, kind);
    if (state.condition == StageState::Condition::finished) last = state.folder;
  }
  return last;
}

bool has_ended(const std::filesystem::path& run_folder) {
  bool ended = false;
  for (const nlohmann::json& record : read_run(run_folder).journal) {
    const std::string event = record.value("event", "");
    if (event == "campaign-ended") ended = true;
    if (event == "stage-started") ended = false;
  }
  return ended;
}

}  // namespace cupola
