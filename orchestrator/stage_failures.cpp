#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <thread>

#include "orchestrator/campaign_difference.hpp"
#include "orchestrator/failure_text.hpp"
#include "orchestrator/stage_runner.hpp"
#include "schemas/checkpoint_seal.hpp"
#include "schemas/files.hpp"

/// What StageRunner makes of stages that did not end well.
namespace cupola {
namespace {

using nlohmann::json;
using namespace std::chrono_literals;

/// What a status of our own means; empty for any other, such as that of a signal.
std::string meaning_of(int status) {
  switch (status) {
    case static_cast<int>(ExitCode::wrong_input):
      return "the input is wrong";
    case static_cast<int>(ExitCode::diverged):
      return "the numbers went bad";
    case static_cast<int>(ExitCode::input_output):
      return "a file could not be read or written";
    default:
      return "";
  }
}

/// All that a failed attempt advises.
std::map<std::string, std::string> advice_of(const json& failure) {
  return failure.value("advice", std::map<std::string, std::string>{});
}

/// What of it is about numerics and is done unasked; a furnace is not changed to make a stage pass.
std::map<std::string, std::string> advice_to_take(std::map<std::string, std::string> advice) {
  std::erase_if(advice, [](const auto& change) {
    return !change.first.starts_with("dem.") && !change.first.starts_with("tracer.");
  });
  return advice;
}

/// How long to wait before a stage that died is started again, by how often it has.
constexpr std::array<std::chrono::seconds, 3> waits{0s, 2s, 10s};

/// Step of the newest whole checkpoint; -1 where there is none.
long checkpoint_step(const std::filesystem::path& folder) {
  long step = -1;
  for (const CheckpointSeal& checkpoint : find_checkpoints(folder)) step = std::max(step, checkpoint.step.value_or(-1));
  return step;
}

/// Makes the folder of a new attempt that goes on from the last checkpoint of the one before, whole or not at all.
void begin_from_checkpoint(const std::filesystem::path& before, const std::filesystem::path& folder) {
  const std::filesystem::path building = temporary_beside(folder);
  std::filesystem::remove_all(building);
  std::filesystem::create_directories(building);
  copy_checkpoints(before, building);
  if (std::filesystem::exists(before / "history.jsonl"))
    std::filesystem::copy_file(before / "history.jsonl", building / "history.jsonl");
  publish(building, folder);
}

}  // namespace

void StageRunner::begin_retry(StagePlace& place, const StageState& state, Patience& patience) {
  const std::string sentence = what_happened(*state.failure);
  const std::map<std::string, std::string> advice = advice_of(*state.failure);
  const std::map<std::string, std::string> changes = advice_to_take(advice);
  // A stage found failed at the start of this run is tried again because somebody asked for it.
  const bool failed_before_us = patience.starts == 0;
  const auto give_up = [&](const std::string& why) {
    Failure failure(ExitCode::diverged, fmt::format("{} (attempt {}): {}. {} Everything is kept in {}.", name_of(place),
                                                    place.attempt, sentence, why, state.folder.string()));
    for (const auto& [key, value] : advice) failure.advise(key, value);
    return failure;
  };
  if (patience.retries > 0) throw give_up("It was tried twice.");
  if (changes.empty() && !failed_before_us)
    throw give_up(advice.empty() ? "It gives no advice what to change, so it would end the same."
                                 : "What it advises changes the bed itself and is left to you.");
  ++patience.retries;
  if (!changes.empty()) {
    Campaign changed = campaign_in_force();
    for (const auto& [key, value] : changes) changed = with_changed_key(changed, key, value);
  }
  place.attempt = state.attempt + 1;
  begin_anew_where_removed(place);
  json content = about(place);
  content["because"] = sentence;
  content["changes"] = changes;
  // Where the attempt has come no further than the checkpoint it began from, that one may be what is bad.
  const json* own_beginning =
      last_record(run_.journal().records(), "advice-taken", place.episode, place.kind, state.attempt);
  const long step = checkpoint_step(state.folder);
  const bool from_checkpoint =
      step > (own_beginning != nullptr ? own_beginning->value("from_checkpoint_step", -1L) : -1L);
  content["from_checkpoint_step"] = from_checkpoint ? json(step) : json(-1);
  run_.journal().append("advice-taken", content);
  std::vector<std::string> words;
  for (const auto& [key, value] : changes) words.push_back(key + " = " + value);
  view_.say(fmt::format("{}: {}\n  tried again from {}{}{}", name_of(place), sentence,
                        from_checkpoint ? fmt::format("its checkpoint at step {}", step) : "its beginning",
                        words.empty() ? "" : ", with ", fmt::join(words, ", ")));
  if (from_checkpoint)
    begin_from_checkpoint(state.folder, folder(place));
  else
    std::filesystem::create_directories(folder(place));
}

bool StageRunner::judge_end(const StagePlace& place, int status, Patience& patience) {
  const std::filesystem::path task = folder(place);
  if (status == static_cast<int>(ExitCode::done)) {
    if (has_manifest(task)) return true;
    throw Failure(ExitCode::input_output, fmt::format("{}: ended well but left no manifest in {}; see its stage.log.",
                                                      name_of(place), task.string()));
  }
  json content = about(place);
  content["status"] = status;
  const auto failure = read_failure(task);
  const bool stop_asked = signals_.stop_requests() > 0;
  if (status == static_cast<int>(ExitCode::stopped) || (stop_asked && !failure)) {
    run_.journal().append("stage-stopped", content);
    return false;
  }
  if (failure) {
    content["failure"] = *failure;
    run_.journal().append("stage-failed", content);
    const int code = failure->value("code", 0);
    if (code == static_cast<int>(ExitCode::diverged)) return true;  // finish() sees it failed
    throw Failure(code == static_cast<int>(ExitCode::wrong_input) ? ExitCode::wrong_input : ExitCode::input_output,
                  fmt::format("{}: {} ({})", name_of(place), what_happened(*failure), task.string()));
  }
  // A status of ours without failure.json: the disk did not even take that.
  if (const std::string meaning = meaning_of(status); !meaning.empty()) {
    run_.journal().append("stage-died", content);
    throw Failure(static_cast<ExitCode>(status),
                  fmt::format("{}: ended with status {} ({}) and could not write down why: is the disk full? See {}.",
                              name_of(place), status, meaning, (task / "stage.log").string()));
  }
  run_.journal().append("stage-died", content);
  be_patient(place, status, patience);
  return true;
}

bool StageRunner::judge_job(const StagePlace& place, const JobEnd& end, Patience& patience) {
  const std::filesystem::path task = folder(place);
  if (has_manifest(task)) return true;
  if (const auto failure = read_failure(task)) return judge_end(place, failure->value("code", 0), patience);
  json content = about(place);
  content["why"] = end.sentence;
  if (end.by_hand || signals_.stop_requests() > 0) {
    run_.journal().append("stage-stopped", content);
    if (end.by_hand) view_.say(end.sentence + " by hand");
    return false;
  }
  if (!end.cut_off) return judge_end(place, end.status.value_or(-1), patience);
  run_.journal().append("stage-stopped", content);
  const auto progress = read_progress(task);
  const long step = progress ? progress->step : -1;
  patience.idle_jobs = step > patience.last_step ? 0 : patience.idle_jobs + 1;
  patience.last_step = std::max(step, patience.last_step);
  constexpr int most_idle_jobs = 3;
  if (patience.idle_jobs >= most_idle_jobs)
    throw Failure(ExitCode::stopped,
                  fmt::format("{}: {} jobs on end got no further ({}). Give launch.slurm.time more, or see {}. "
                              "`cupola resume` tries again.",
                              name_of(place), most_idle_jobs, end.sentence, (task / "stage.log").string()));
  view_.say(fmt::format("{}: cut off by the cluster; the next job goes on from its checkpoint", end.sentence));
  return true;
}

void StageRunner::be_patient(const StagePlace& place, int status, Patience& patience) {
  const std::filesystem::path task = folder(place);
  if (const long step = checkpoint_step(task); step > patience.step_lived) {
    patience.step_lived = step;
    patience.deaths = 0;
  }
  if (patience.deaths == static_cast<int>(waits.size()))
    throw Failure(ExitCode::diverged,
                  fmt::format("{}: ended without saying why (status {}), for the {}th time without getting on; see {}. "
                              "`cupola resume` goes on from its checkpoint.",
                              name_of(place), status, waits.size() + 1, (task / "stage.log").string()));
  const auto wait = waits.at(static_cast<std::size_t>(patience.deaths++));
  view_.say(fmt::format("{}: ended without saying why (status {}); started again from its checkpoint{}", name_of(place),
                        status, wait > 0s ? fmt::format(" in {} s", wait.count()) : ""));
  const auto until = std::chrono::steady_clock::now() + wait;
  while (std::chrono::steady_clock::now() < until && signals_.stop_requests() == 0) signals_.wait(500ms);
  // The other ranks may still be on their way out.
  for (int tenths = 0; tenths < 50 && FolderLock::holder(task); ++tenths) std::this_thread::sleep_for(100ms);
}

}  // namespace cupola
