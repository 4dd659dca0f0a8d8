#include "orchestrator/launch/slurm_queue.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <sstream>

#include "orchestrator/launch/program_output.hpp"
#include "schemas/failure.hpp"

namespace cupola {
namespace {

using namespace std::chrono_literals;
using Phase = JobState::Phase;

constexpr auto patience = 60s;  // a busy controller may take that long

std::string first_line(const std::string& text) { return text.substr(0, text.find('\n')); }

/// The part of a line up to the separator, and what follows it.
std::pair<std::string, std::string> split(const std::string& line, char separator) {
  const std::size_t at = line.find(separator);
  if (at == std::string::npos) return {line, ""};
  return {line.substr(0, at), line.substr(at + 1)};
}

Phase phase_of(const std::string& word) {
  constexpr std::array waiting = {"PENDING",     "REQUEUED",     "REQUEUE_HOLD",
                                  "REQUEUE_FED", "SPECIAL_EXIT", "RESV_DEL_HOLD"};
  constexpr std::array running = {"RUNNING",   "COMPLETING", "CONFIGURING", "SIGNALING",
                                  "STAGE_OUT", "SUSPENDED",  "STOPPED",     "RESIZING"};
  if (std::find(waiting.begin(), waiting.end(), word) != waiting.end()) return Phase::waiting;
  if (std::find(running.begin(), running.end(), word) != running.end()) return Phase::running;
  return Phase::ended;
}

/// `75:0` and `0:9` as an exit status.
std::optional<int> status_of(const std::string& text) {
  const auto [code, signal] = split(text, ':');
  if (code.empty() || signal.empty()) return std::nullopt;
  const int number = std::atoi(signal.c_str());
  return number > 0 ? 128 + number : std::atoi(code.c_str());
}

/// The value of `Key=value` among blanks.
std::string value_of(const std::string& line, const std::string& key) {
  std::istringstream words(line);
  for (std::string word; words >> word;)
    if (word.starts_with(key + "=")) return word.substr(key.size() + 1);
  return "";
}

bool is_unknown_job(const std::string& complaint) { return complaint.find("Invalid job id") != std::string::npos; }

/// What Slurm says when it cannot be reached rather than does not want to.
bool is_out_of_reach(const ProgramOutput& said) {
  for (const char* sign : {"Unable to contact", "Socket timed out", "Connection refused", "did not answer",
                           "Zero Bytes were transmitted", "authentication", "temporarily unable"})
    if (said.error.find(sign) != std::string::npos) return true;
  return said.status == 127;
}

/// `%` would begin one of sbatch's own patterns.
std::string without_patterns(std::string path) {
  for (std::size_t at = path.find('%'); at != std::string::npos; at = path.find('%', at + 2)) path.insert(at, 1, '%');
  return path;
}

}  // namespace

std::vector<std::string> sbatch_words(const Launch& launch, const BatchJob& job) {
  const SlurmLaunch& slurm = launch.slurm.value();
  const auto seconds = static_cast<long>(std::ceil(slurm.time));
  std::vector<std::string> words = {
      "sbatch",
      "--parsable",
      "--job-name=" + job.name,
      fmt::format("--ntasks={}", launch.ranks),
      fmt::format("--time={}:{:02}", seconds / 60, seconds % 60),
      // Only the batch shell, which has become mpirun by then, or cupola: both pass it on to all ranks.
      fmt::format("--signal=B:USR1@{}", static_cast<long>(std::ceil(slurm.checkpoint_before))),
      "--requeue",
      "--open-mode=append",
      "--output=" + without_patterns(job.log.string()),
      "--chdir=" + job.folder.string(),
  };
  const auto add = [&](const char* option, const std::string& value) {
    if (!value.empty()) words.push_back(fmt::format("--{}={}", option, value));
  };
  add("partition", slurm.partition);
  add("account", slurm.account);
  add("qos", slurm.qos);
  if (slurm.nodes > 0) add("nodes", std::to_string(slurm.nodes));
  add("array", job.array);
  if (!job.after.empty()) {
    words.push_back((job.after_any_end ? "--dependency=afterany:" : "--dependency=afterok:") + job.after);
    words.emplace_back("--kill-on-invalid-dep=yes");
  }
  words.insert(words.end(), slurm.options.begin(), slurm.options.end());
  words.push_back(job.script.string());
  return words;
}

JobState job_state_from(const std::string& squeue_line, const std::string& scontrol_line) {
  JobState state;
  std::tie(state.word, state.reason) = split(first_line(squeue_line), '|');
  state.phase = phase_of(state.word);
  state.restarts = std::atoi(value_of(scontrol_line, "Restarts").c_str());
  if (state.phase == Phase::ended) state.status = status_of(value_of(scontrol_line, "ExitCode"));
  return state;
}

JobState job_state_from_accounting(const std::string& sacct_line) {
  JobState state;
  const auto [word, status] = split(first_line(sacct_line), '|');
  state.word = word.substr(0, word.find(' '));  // `CANCELLED by 1000`
  state.phase = phase_of(state.word);
  if (state.phase == Phase::ended) state.status = status_of(status);
  return state;
}

std::string SlurmQueue::submit(const Launch& launch, const BatchJob& job) {
  const ProgramOutput said = output_of(sbatch_words(launch, job), patience);
  if (said.status != 0) {
    const bool out_of_reach = is_out_of_reach(said);
    throw Failure(out_of_reach ? ExitCode::input_output : ExitCode::wrong_input,
                  fmt::format("sbatch took no job: {}. {}", first_line(said.error),
                              out_of_reach ? "See that Slurm runs and sbatch can reach it, then resume."
                                           : "Change launch.slurm in a new run folder."))
        .at("key", "launch.slurm");
  }
  return split(first_line(said.output), ';').first;  // on federated clusters `123;cluster`
}

JobState SlurmQueue::state(const std::string& job) {
  const ProgramOutput queue =
      output_of({"squeue", "--noheader", "--states=all", "--jobs=" + job, "--format=%T|%r"}, patience);
  if (queue.status == 0 && !queue.output.empty())
    return job_state_from(queue.output, output_of({"scontrol", "--oneliner", "show", "job", job}, patience).output);
  if (queue.status != 0 && !is_unknown_job(queue.error))
    return {Phase::unreachable, "", first_line(queue.error), {}, 0};
  const ProgramOutput accounting = output_of(
      {"sacct", "--noheader", "--parsable2", "--allocations", "--jobs=" + job, "--format=State,ExitCode"}, patience);
  if (accounting.status == 0 && !accounting.output.empty()) return job_state_from_accounting(accounting.output);
  return {Phase::forgotten, "", "", {}, 0};
}

std::optional<std::vector<std::string>> SlurmQueue::unfinished(const std::string& name) {
  const ProgramOutput queue = output_of({"squeue", "--noheader", "--name=" + name, "--format=%A"}, patience);
  if (queue.status != 0) return std::nullopt;
  std::vector<std::string> jobs;
  std::istringstream lines(queue.output);
  for (std::string job; lines >> job;) jobs.push_back(job);
  return jobs;
}

void SlurmQueue::ask_to_stop(const std::string& job) {
  output_of({"scancel", "--quiet", "--batch", "--signal=USR1", job}, patience);
}

void SlurmQueue::cancel(const std::vector<std::string>& jobs) {
  if (jobs.empty()) return;
  std::vector<std::string> words = {"scancel", "--quiet"};
  words.insert(words.end(), jobs.begin(), jobs.end());
  output_of(words, patience);
}

bool SlurmQueue::requeue(const std::string& job) {
  return output_of({"scontrol", "requeue", job}, patience).status == 0;
}

}  // namespace cupola
