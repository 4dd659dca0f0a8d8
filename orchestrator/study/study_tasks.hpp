#pragma once
#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "orchestrator/study/study_file.hpp"
#include "schemas/task.hpp"

namespace cupola {

/// A piece of a study's work: a stage in a task folder, or a whole campaign in a run folder.  The folder's name is a
/// hash of all that it depends on, so that settings share what they have in common, a study that goes on finds what is
/// done, and one whose file has grown runs only what is new.
struct StudyTask {
  enum class State { waiting, running, finished, failed, stopped };
  bool is_run = false;            ///< a whole campaign
  TaskKind kind = TaskKind::dem;  ///< of a stage
  int episode = 1;
  Campaign campaign;                          ///< with the seed
  std::string campaign_text;                  ///< as a campaign file, with the seed
  std::string campaign_hash;                  ///< as the task carries it
  std::map<std::string, std::size_t> inputs;  ///< by the names of Task::inputs: tasks that come before
  std::filesystem::path folder;               ///< absolute
  State state = State::waiting;
  std::string sentence;  ///< why it failed; of a campaign also how it ended
  [[nodiscard]] std::string name() const { return folder.filename().string(); }
};

/// The work of one setting with one seed, as indices of tasks.
struct StudyRun {
  std::size_t setting = 0;
  int seed = 0;                     ///< from 0: the scene's seed and what is added to it
  std::vector<std::size_t> shared;  ///< run once for several settings: not in its cost
  std::vector<std::size_t> own;     ///< what is varied; the last one's result counts
  [[nodiscard]] std::size_t last() const { return own.back(); }
};

/// All work of a study, what comes first standing first; references stand before what is compared with them.
struct StudyWork {
  std::vector<StudyTask> tasks;
  std::vector<StudyRun> runs;  ///< setting by setting, seed by seed
};

/// @param folder of the study, absolute; nothing is made in it
StudyWork study_work(const Study& study, const std::filesystem::path& folder);

/// Looks into the folder: finished, failed or waiting (what is half done goes on).
void look_after(StudyTask& task);

/// Whether all tasks before it have finished; where one has failed, the task fails for that reason.
bool is_ready(StudyTask& task, const std::vector<StudyTask>& tasks);

/// Makes the task folder (or writes the campaign file) of a task that is ready.
void make_folder(const StudyTask& task, const std::vector<StudyTask>& tasks);

}  // namespace cupola
