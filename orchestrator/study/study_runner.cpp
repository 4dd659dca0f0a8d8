#include "orchestrator/study/study_runner.hpp"

#include <fmt/format.h>

#include <chrono>
#include <fstream>

#include "physics/stage/stage_log.hpp"
#include "schemas/failure.hpp"
#include "schemas/files.hpp"

namespace cupola {
namespace {

using namespace std::chrono_literals;
namespace fs = std::filesystem;
using State = StudyTask::State;

/// What a campaign that was run said last.
std::string last_line(const fs::path& log) {
  std::ifstream file(log);
  std::string last;
  for (std::string line; std::getline(file, line);)
    if (!line.empty()) last = line;
  return last;
}

Command run_campaign(const StudyTask& task, const StageLauncher& launcher) {
  Command command;
  command.words = {(launcher.folder() / "cupola").string(), "run", (task.folder / "campaign.yaml").string(),
                   "--run-dir", (task.folder / "run").string()};
  command.log = task.folder / "cupola.log";
  return command;
}

}  // namespace

StudyRunner::StudyRunner(std::vector<StudyTask>& tasks, const StageLauncher& launcher, SignalWatch& signals, int jobs,
                         std::function<void(const StudyTask&)> after_task)
    : tasks_(tasks),
      launcher_(launcher),
      signals_(signals),
      jobs_(static_cast<std::size_t>(jobs)),
      after_task_(std::move(after_task)) {}

bool StudyRunner::go() {
  for (;;) {
    if (signals_.stop_requests() == 0) start_what_is_ready();
    if (running_.empty()) break;
    signals_.wait(200ms);
    for (auto one = running_.begin(); one != running_.end();)
      one = look_at(*one) ? running_.erase(one) : std::next(one);
  }
  for (const StudyTask& task : tasks_)
    if (task.state == State::waiting || task.state == State::stopped) return false;
  return true;
}

void StudyRunner::start_what_is_ready() {
  for (std::size_t i = 0; i < tasks_.size() && running_.size() < jobs_; ++i) {
    const bool waited = tasks_[i].state == State::waiting;
    if (is_ready(tasks_[i], tasks_)) {
      begin(i);
    } else if (waited && tasks_[i].state == State::failed) {
      after_task_(tasks_[i]);
    }
  }
}

void StudyRunner::begin(std::size_t index) {
  StudyTask& task = tasks_[index];
  try {
    make_folder(task, tasks_);
    fs::remove(task.folder / "failure.json");
    start(index, !task.is_run && !fs::exists(task.folder / "foam" / "prepared.json"));
    task.state = State::running;
  } catch (const Failure& failure) {
    task.state = State::failed;
    task.sentence = failure.what();
    after_task_(task);
  }
}

void StudyRunner::start(std::size_t index, bool preparing) {
  const StudyTask& task = tasks_[index];
  Command command = task.is_run ? run_campaign(task, launcher_)
                    : preparing ? launcher_.prepare(task.kind, task.folder)
                                : launcher_.run(task.kind, task.folder, task.campaign.launch);
  command.ends_with_us = true;
  command.environment.emplace(stderr_goes_to_log, "1");
  auto process = std::make_unique<ChildProcess>(command, signals_.former_mask());
  process->release();
  running_.push_back({index, preparing, std::move(process)});
}

bool StudyRunner::look_at(Running& running) {
  StudyTask& task = tasks_[running.task];
  if (const int asked = signals_.stop_requests(); asked > running.asked) {
    running.asked = asked;
    running.process->signal(task.is_run || running.preparing ? SIGTERM : SIGUSR1);
  }
  const auto status = running.process->poll();
  if (!status) return false;
  if (running.preparing && *status == 0 && signals_.stop_requests() == 0) {
    start(running.task, false);
    return true;
  }
  judge(task, running.preparing && *status == 0 ? static_cast<int>(ExitCode::stopped) : *status);
  if (task.state != State::stopped) after_task_(task);
  return true;
}

void StudyRunner::judge(StudyTask& task, int status) {
  const bool stopped = signals_.stop_requests() > 0 && (status == static_cast<int>(ExitCode::stopped) || status > 128);
  if (stopped) {
    task.state = State::stopped;
  } else if (task.is_run) {
    const bool finished = status == static_cast<int>(ExitCode::done) || status == static_cast<int>(ExitCode::stopped);
    write_json_atomically(task.folder / "outcome.json",
                          {{"finished", finished}, {"sentence", last_line(task.folder / "cupola.log")}});
    look_after(task);
  } else {
    look_after(task);
    if (task.state == State::waiting) {
      task.state = State::failed;
      task.sentence =
          fmt::format("ended without saying why (status {}); see {}", status, (task.folder / "stage.log").string());
    }
  }
}

}  // namespace cupola
