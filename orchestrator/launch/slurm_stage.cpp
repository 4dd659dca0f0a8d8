#include "orchestrator/launch/slurm_stage.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <chrono>

#include "orchestrator/launch/job_name.hpp"
#include "orchestrator/launch/job_script.hpp"
#include "orchestrator/stage_state.hpp"

namespace cupola {
namespace {

using nlohmann::json;
using namespace std::chrono_literals;
using Clock = std::chrono::steady_clock;
using Phase = JobState::Phase;

/// How often Slurm is asked: the longer a job takes, the more seldom; controllers serve many.
std::chrono::milliseconds between_questions(Clock::duration followed) {
  if (followed < 1min) return 1s;
  return followed < 10min ? 5s : 15s;
}

/// The last job of an attempt that the journal has not seen end: its `job-submitting` or `job-submitted` record.
const json* open_job(const std::vector<json>& journal, const StagePlace& place) {
  const json* open = nullptr;
  for (const json& record : journal) {
    if (!is_about(record, place.episode, place.kind, place.attempt)) continue;
    const std::string event = record.value("event", "");
    if (event == "job-submitting" || event == "job-submitted") open = &record;
    if (event == "job-ended") open = nullptr;
  }
  return open;
}

JobEnd end_of(const std::string& job, const JobState& state) {
  constexpr std::array by_cluster = {"TIMEOUT", "PREEMPTED", "NODE_FAIL", "BOOT_FAIL", "DEADLINE"};
  JobEnd end;
  end.status = state.status;
  end.cut_off = std::find(by_cluster.begin(), by_cluster.end(), state.word) != by_cluster.end() ||
                state.status == static_cast<int>(ExitCode::stopped);
  end.by_hand = state.word == "CANCELLED";
  end.sentence = fmt::format("job {}: {}", job, state.word.empty() ? "over" : state.word);
  return end;
}

std::string waiting_line(const StagePlace& place, const std::filesystem::path& task, const std::string& job,
                         const JobState& state) {
  if (state.phase == Phase::unreachable)
    return fmt::format("{} · job {} · Slurm does not answer ({})", progress_line(place, read_progress(task)), job,
                       state.reason);
  return fmt::format("{} · job {} waits ({}{})", progress_line(place, std::nullopt), job, state.reason,
                     state.restarts > 0 ? fmt::format(", put back {} times", state.restarts) : "");
}

}  // namespace

json SlurmStage::about(const StagePlace& place) const {
  return {{"episode", place.episode}, {"stage", stage_name(place.kind)}, {"attempt", place.attempt}};
}

JobEnd SlurmStage::run(const StagePlace& place) {
  const std::filesystem::path task = task_folder(run_.path(), place.episode, place.kind, place.attempt);
  const Launch& launch = run_.campaign().launch;
  const BatchJob job{job_name(run_, fmt::format("e{}-{}", place.episode, stage_name(place.kind))), task / "job.sh",
                     task, task / "stage.log", ""};
  write_text_atomically(job.script, stage_script(*launch.slurm, launcher_.prepare(place.kind, task).words,
                                                 launcher_.words_in_job(place.kind, task, launch)));
  json content = about(place);
  content["name"] = job.name;
  run_.journal().append("job-submitting", content);
  std::string number;
  try {
    number = SlurmQueue::submit(launch, job);
  } catch (const Failure& failure) {
    content["state"] = "not taken";
    content["sentence"] = failure.what();
    run_.journal().append("job-ended", content);
    throw;
  }
  content["job"] = number;
  run_.journal().append("job-submitted", content);
  return follow(place, number);
}

std::optional<JobEnd> SlurmStage::find_again(const StagePlace& place) {
  const json* open = open_job(run_.journal().records(), place);
  if (open == nullptr) return std::nullopt;
  if (open->contains("job")) return follow(place, (*open)["job"].get<std::string>());
  // Whoever submitted it died before it knew the number.
  const std::string name = open->value("name", "");
  const auto jobs = SlurmQueue::unfinished(name);
  if (!jobs)
    throw Failure(
        ExitCode::input_output,
        fmt::format("Slurm does not answer, and whether job {} was submitted is not known. Resume when squeue "
                    "works.",
                    name));
  json content = about(place);
  content["name"] = name;
  if (jobs->empty()) {
    content["state"] = "not found";
    run_.journal().append("job-ended", content);
    return std::nullopt;
  }
  content["job"] = jobs->front();
  run_.journal().append("job-submitted", content);
  return follow(place, jobs->front());
}

JobEnd SlurmStage::follow(const StagePlace& place, const std::string& job) {
  view_.say(fmt::format("{} stage of episode {}: job {}", stage_name(place.kind), place.episode, job));
  const std::filesystem::path task = task_folder(run_.path(), place.episode, place.kind, place.attempt);
  const Clock::time_point begin = Clock::now();
  int passed_on = 0;
  for (;;) {
    const JobState state = SlurmQueue::state(job);
    if (state.phase == Phase::ended || state.phase == Phase::forgotten) {
      const JobEnd end = end_of(job, state);
      json content = about(place);
      content.update({{"job", job}, {"state", state.word}, {"reason", state.reason}, {"restarts", state.restarts}});
      content["status"] = end.status ? json(*end.status) : json();
      run_.journal().append("job-ended", content);
      return end;
    }
    view_.show(state.phase == Phase::running ? progress_line(place, read_progress(task)) + " · job " + job
                                             : waiting_line(place, task, job, state));
    if (const int asked = signals_.stop_requests(); asked > passed_on && state.phase != Phase::unreachable) {
      view_.say(state.phase == Phase::running ? "stopping: the stage ends its block and writes a checkpoint"
                                              : "stopping: the job is taken out of the queue");
      passed_on = asked;
      if (state.phase == Phase::running)
        SlurmQueue::ask_to_stop(job);
      else
        SlurmQueue::cancel({job});
    }
    signals_.wait(between_questions(Clock::now() - begin));
  }
}

}  // namespace cupola
