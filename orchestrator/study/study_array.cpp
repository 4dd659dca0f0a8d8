#include "orchestrator/study/study_array.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

#include "orchestrator/launch/job_script.hpp"
#include "orchestrator/launch/slurm_queue.hpp"
#include "orchestrator/stage_launcher.hpp"
#include "schemas/failure.hpp"
#include "schemas/files.hpp"

namespace cupola {
namespace {

using State = StudyTask::State;
namespace fs = std::filesystem;

}  // namespace

std::vector<std::vector<std::size_t>> array_layers(const std::vector<StudyTask>& tasks) {
  std::vector<std::size_t> depth(tasks.size(), 0);
  std::vector<std::vector<std::size_t>> layers;
  for (std::size_t i = 0; i < tasks.size(); ++i) {
    if (tasks[i].state == State::finished || tasks[i].state == State::failed) continue;
    // An input stands before what rests on it.
    for (const auto& [name, input] : tasks[i].inputs)
      if (tasks[input].state != State::finished) depth[i] = std::max(depth[i], depth[input] + 1);
    if (layers.size() <= depth[i]) layers.resize(depth[i] + 1);
    layers[depth[i]].push_back(i);
  }
  return layers;
}

std::string array_list(const std::vector<std::size_t>& members, int at_once) {
  std::string text;
  for (std::size_t i = 0; i < members.size();) {
    std::size_t end = i;
    while (end + 1 < members.size() && members[end + 1] == members[end] + 1) ++end;
    text += fmt::format("{}{}", text.empty() ? "" : ",", members[i]);
    if (end > i) text += fmt::format("-{}", members[end]);
    i = end + 1;
  }
  return at_once > 0 ? fmt::format("{}%{}", text, at_once) : text;
}

std::vector<std::string> submit_study(const Study& study, const StudyWork& work, const fs::path& folder) {
  const Launch& launch = study.scene.launch;
  if (!launch.slurm)
    throw Failure(ExitCode::wrong_input,
                  fmt::format("{}: --submit needs `launch: {{slurm: …}}` in the scene, or in the study's `change`",
                              study.file.string()));
  const std::string cupola = (StageLauncher::own_folder() / "cupola").string();
  std::vector<std::string> begin = {cupola, "study", study.file.string(), "--study-dir", folder.string()};
  if (study.size == StudySize::reduced) begin.emplace_back("--reduced");
  const fs::path log = folder / "slurm.log";
  std::vector<std::string> jobs;
  const auto layers = array_layers(work.tasks);
  const auto submit = [&](const std::string& name, const std::string& script_text, const std::string& array,
                          int ranks) {
    const fs::path script = folder / (name + ".sh");
    write_text_atomically(script, script_text);
    Launch with = launch;
    with.ranks = ranks;
    BatchJob job{study.name + "-" + name, script, folder, log};
    job.array = array;
    job.after = jobs.empty() ? "" : jobs.back();
    job.after_any_end = true;  // a failed setting is a row that says so
    jobs.push_back(SlurmQueue::submit(with, job));
  };
  for (std::size_t layer = 0; layer < layers.size(); ++layer) {
    int ranks = 1;
    for (const std::size_t task : layers[layer]) ranks = std::max(ranks, work.tasks[task].campaign.launch.ranks);
    std::vector<std::string> words = begin;
    words.emplace_back("--task");
    std::string text = link_script(*launch.slurm, words);
    // The number is the shell's to fill in.
    text.insert(text.size() - 1, " \"$SLURM_ARRAY_TASK_ID\"");
    submit(fmt::format("array-{}", layer + 1), text, array_list(layers[layer], study.jobs), ranks);
  }
  std::vector<std::string> words = begin;
  words.emplace_back("--gather");
  submit("gather", link_script(*launch.slurm, words), "", 1);
  return jobs;
}

}  // namespace cupola
