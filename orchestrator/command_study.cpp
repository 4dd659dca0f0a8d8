#include <fmt/format.h>

#include <algorithm>
#include <thread>

#include "orchestrator/commands.hpp"
#include "orchestrator/quantity_text.hpp"
#include "orchestrator/signal_watch.hpp"
#include "orchestrator/stage_launcher.hpp"
#include "orchestrator/study/study_array.hpp"
#include "orchestrator/study/study_results.hpp"
#include "orchestrator/study/study_runner.hpp"
#include "schemas/files.hpp"

namespace cupola {
namespace {

namespace fs = std::filesystem;
using State = StudyTask::State;
using nlohmann::json;

fs::path make_study_folder(const Study& study, const std::optional<fs::path>& wanted) {
  const std::string own_name = study.name + (study.size == StudySize::reduced ? "-reduced" : "");
  const fs::path folder = fs::absolute(wanted.value_or(fs::path("studies") / own_name)).lexically_normal();
  std::error_code error;
  fs::create_directories(folder / "stages", error);
  if (error)
    throw Failure(ExitCode::input_output,
                  fmt::format("{}: cannot be made: {}. Choose another --study-dir.", folder.string(), error.message()));
  return folder;
}

/// What failed is tried again where that is asked for.
void forget_failures(StudyWork& work) {
  for (StudyTask& task : work.tasks) {
    if (task.state != State::failed) continue;
    fs::remove(task.folder / "failure.json");
    fs::remove(task.folder / "outcome.json");
    if (!has_manifest(task.folder)) look_after(task);
  }
}

void say_results(const json& results, const fs::path& folder) {
  for (const json& setting : results["settings"]) {
    std::string text;
    for (const auto& [name, error] : setting["errors"].items()) {
      const json& bar = error["standard_error"];
      text += error["mean"].is_number()
                  ? fmt::format("  {} {:.3g}{}", name, error["mean"].get<double>(),
                                bar.is_number() ? fmt::format(" ± {:.2g}", bar.get<double>()) : "")
                  : "";
    }
    if (setting["is_reference"]) text = "  the reference";
    for (const json& run : setting["runs"])
      if (run["state"] != "finished")
        text += fmt::format("  seed {}: {}: {}", run["seed"].get<int>(), run["state"].get<std::string>(),
                            run["sentence"].get<std::string>());
    const json& wall = setting["wall_seconds"]["mean"];
    fmt::print("{:<60} {:>10}{}\n", setting["label"].get<std::string>(),
               wall.is_number() ? duration_text(wall.get<double>()) : "-", text);
  }
  for (const json& metric : results["metrics"])
    if (metric["knee"].is_number())
      fmt::print("knee of {}: {}\n", metric["name"].get<std::string>(),
                 results["settings"][metric["knee"].get<std::size_t>()]["label"].get<std::string>());
  fmt::print("{}\n", (folder / "index.html").string());
}

/// Where nothing can be compared, a script must notice.
ExitCode outcome(const json& results) {
  bool any = false, compared = false;
  for (const json& setting : results["settings"]) {
    any = any || setting["wall_seconds"]["mean"].is_number();
    for (const auto& [name, error] : setting["errors"].items()) compared = compared || error["mean"].is_number();
  }
  if (compared) return ExitCode::done;
  fmt::print(stderr, "{}\n", any ? "nothing could be compared: the reference did not finish" : "no setting finished");
  return ExitCode::diverged;
}

ExitCode run_one_task(StudyWork& work, std::size_t index) {
  if (index >= work.tasks.size())
    throw Failure(ExitCode::wrong_input, fmt::format("this study has {} tasks, counted from 0", work.tasks.size()));
  SignalWatch signals;
  StudyTask& task = work.tasks[index];
  if (task.state == State::finished) return ExitCode::done;
  std::vector<StudyTask> alone = work.tasks;
  for (std::size_t i = 0; i < alone.size(); ++i)
    if (i != index && alone[i].state == State::waiting) alone[i].state = State::stopped;
  const StageLauncher launcher(StageLauncher::own_folder());
  StudyRunner runner(alone, launcher, signals, 1, [](const StudyTask& ended) {
    fmt::print("{}: {}\n", ended.name(), ended.state == State::finished ? "finished" : ended.sentence);
  });
  runner.go();
  return alone[index].state == State::stopped ? ExitCode::stopped : ExitCode::done;
}

void warn_of_cores(const Study& study) {
  const int ranks = study.jobs * study.scene.launch.ranks;
  const int cores = static_cast<int>(std::thread::hardware_concurrency());
  if (cores > 0 && ranks > cores)
    fmt::print("note: {} jobs of {} ranks on {} hardware threads: wall times will be those of a crowded machine\n",
               study.jobs, study.scene.launch.ranks, cores);
}

}  // namespace

ExitCode study(const fs::path& study_file, const StudyOptions& options) {
  Study study = load_study(study_file, options.reduced ? StudySize::reduced : StudySize::full);
  if (options.jobs) study.jobs = *options.jobs;
  if (options.only_check) {
    fmt::print("{}: {} settings x {} seeds, error against {}\n", study.name, study.settings.size(), study.seeds,
               study.reference.sentence);
    for (const StudySetting& setting : study.settings) fmt::print("  {}\n", setting.label());
    return ExitCode::done;
  }
  const fs::path folder = make_study_folder(study, options.folder);
  StudyWork work = study_work(study, folder);
  for (StudyTask& task : work.tasks) look_after(task);
  if (options.task) return run_one_task(work, *options.task);
  const FolderLock lock(folder);
  write_text_atomically(folder / "study.yaml", read_text(study.file));
  if (options.retry_failed) forget_failures(work);
  if (options.submit) {
    const auto jobs = submit_study(study, work, folder);
    fmt::print("{}: queued as {} jobs; the last one, {}, gathers the results in {}\n", study.name, jobs.size(),
               jobs.back(), (folder / "index.html").string());
    return ExitCode::done;
  }
  bool complete = true;
  if (!options.only_gather) {
    warn_of_cores(study);
    SignalWatch signals;
    const StageLauncher launcher(StageLauncher::own_folder());
    std::size_t ended = 0;
    StudyRunner runner(work.tasks, launcher, signals, study.jobs, [&](const StudyTask& task) {
      ++ended;
      fmt::print("{}: {}\n", task.name(), task.state == State::finished ? "finished" : "failed: " + task.sentence);
      std::fflush(stdout);
      write_study_report(folder, study_results(study, work));
    });
    complete = runner.go();
  }
  const json results = study_results(study, work);
  write_study_report(folder, results);
  say_results(results, folder);
  if (!complete) {
    fmt::print("stopped; the same command goes on.\n");
    return ExitCode::stopped;
  }
  return outcome(results);
}

}  // namespace cupola
