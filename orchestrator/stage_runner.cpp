#include "orchestrator/stage_runner.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <thread>

#include "orchestrator/campaign_difference.hpp"
#include "orchestrator/prepared_case.hpp"
#include "orchestrator/quantity_text.hpp"
#include "orchestrator/result_check.hpp"
#include "orchestrator/run_check.hpp"
#include "orchestrator/stage_task.hpp"
#include "physics/stage/stage_log.hpp"
#include "schemas/checkpoint_seal.hpp"

namespace cupola {
namespace {

using nlohmann::json;
using Condition = StageState::Condition;
using namespace std::chrono_literals;

constexpr auto look_again = 500ms;  // at progress.json

/// `dem stage of episode 2`
std::string name_of(const StagePlace& place) {
  return fmt::format("{} stage of episode {}", stage_name(place.kind), place.episode);
}

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

std::string sentence_of(const json& failure) { return failure.value("sentence", "it did not say why"); }

/// The advice of a failed attempt that is about numerics; a furnace is not changed to make a stage pass.
std::map<std::string, std::string> usable_advice(const json& failure) {
  std::map<std::string, std::string> changes;
  const json none = json::object();
  const json& advice = failure.contains("advice") ? failure["advice"] : none;
  for (const auto& [key, value] : advice.items())
    if (key.starts_with("dem.") || key.starts_with("tracer.")) changes[key] = value.get<std::string>();
  return changes;
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

std::filesystem::path StageRunner::folder(const StagePlace& place) const {
  return task_folder(run_.path(), place.episode, place.kind, place.attempt);
}

json StageRunner::about(const StagePlace& place) const {
  return {{"episode", place.episode}, {"stage", stage_name(place.kind)}, {"attempt", place.attempt}};
}

std::optional<std::filesystem::path> StageRunner::finish(StagePlace place,
                                                         const std::map<std::string, std::filesystem::path>& inputs) {
  Patience patience;
  for (;;) {
    const StageState state = stage_state(run_.path(), run_.journal().records(), place.episode, place.kind);
    place.attempt = state.attempt;
    if (state.condition == Condition::finished) {
      accept(place, state);
      return state.folder;
    }
    if (signals_.stop_requests() > 0) return std::nullopt;
    switch (state.condition) {
      case Condition::running:
        wait_for_orphan(place, state);
        break;
      case Condition::failed:
        begin_retry(place, state, patience);
        break;
      default:
        if (!run_attempt(place, inputs, patience)) return std::nullopt;
    }
  }
}

void StageRunner::accept(const StagePlace& place, const StageState& state) {
  const std::string manifest_hash = hash_file(state.folder / "manifest.json");
  if (state.finished_record) {
    if (state.finished_record->value("manifest_hash", "") != manifest_hash)
      throw Failure(
          ExitCode::input_output,
          fmt::format("{}: not the manifest that the journal knows: the result of the {} was changed or swapped. "
                      "Put the folder back, or begin a new run. {}",
                      (state.folder / "manifest.json").string(), name_of(place), still_whole(run_.path())));
    try {
      verify_manifest(state.folder);
    } catch (Failure& failure) {
      throw Failure(failure.code(), fmt::format("{} {}", failure.what(), still_whole(run_.path())));
    }
    return;
  }
  json content = about(place);
  try {
    check_result(state.folder, place.kind, run_.campaign(), run_.campaign_hash());
  } catch (const Failure& refusal) {
    content["sentence"] = refusal.what();
    run_.journal().append("result-refused", content);
    throw;
  }
  content["manifest_hash"] = manifest_hash;
  content["result_hash"] = hash_file(state.folder / "result.hdf");
  run_.journal().append("stage-finished", content);
  const auto progress = read_progress(state.folder);
  view_.say(fmt::format(
      "{}: finished{}", name_of(place),
      progress ? ", " + duration_text(progress->process_seconds) + " in " + duration_text(progress->wall_seconds)
               : ""));
}

void StageRunner::wait_for_orphan(const StagePlace& place, const StageState& state) {
  view_.say(fmt::format("{}: still runs ({}); waiting for it", name_of(place),
                        state.process ? fmt::format("mpirun is process {}", state.process->pid)
                                      : FolderLock::holder(state.folder).value_or("it is just ending")));
  run_.journal().append("orphan-found", about(place));
  int passed_on = 0;
  const auto lives = [&] {
    return (state.process && state.process->alive()) || FolderLock::holder(state.folder).has_value();
  };
  while (lives()) {
    signals_.wait(look_again);
    view_.show(progress_line(place, read_progress(state.folder)));
    if (const int asked = signals_.stop_requests(); asked > passed_on) {
      passed_on = asked;
      if (!state.process) return;  // elsewhere or without mpirun: it goes on, and the next resume finds it
      view_.say("stopping: the stage ends its block and writes a checkpoint");
      ::kill(state.process->pid, SIGUSR1);
    }
  }
}

void StageRunner::begin_retry(StagePlace& place, const StageState& state, Patience& patience) {
  const std::string sentence = sentence_of(*state.failure);
  const std::map<std::string, std::string> changes = usable_advice(*state.failure);
  // A stage found failed at the start of this run is tried again because somebody asked for it.
  const bool failed_before_us = patience.starts == 0;
  const auto give_up = [&](const std::string& why) {
    Failure failure(ExitCode::diverged, fmt::format("{} (attempt {}): {}. {} Everything is kept in {}.", name_of(place),
                                                    place.attempt, sentence, why, state.folder.string()));
    for (const auto& [key, value] : changes) failure.advise(key, value);
    return failure;
  };
  if (patience.retries > 0) throw give_up("It was tried twice.");
  if (changes.empty() && !failed_before_us)
    throw give_up("It gives no advice what to change, so it would end the same.");
  ++patience.retries;
  if (!changes.empty()) {
    Campaign changed = campaign_in_force();
    for (const auto& [key, value] : changes) changed = with_changed_key(changed, key, value);
  }
  place.attempt = state.attempt + 1;
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

bool StageRunner::run_attempt(const StagePlace& place, const std::map<std::string, std::filesystem::path>& inputs,
                              Patience& patience) {
  ++patience.starts;
  if (const int status = make_ready(place, inputs); status != 0) return judge_end(place, status, patience);
  if (signals_.stop_requests() > 0) return false;
  const std::filesystem::path task = folder(place);
  const int status =
      run_to_end(place, launcher_.run(place.kind, task, ranks()), "stage-started", {{"ranks", ranks()}}, true);
  return judge_end(place, status, patience);
}

int StageRunner::make_ready(const StagePlace& place, const std::map<std::string, std::filesystem::path>& inputs) {
  const std::filesystem::path task = folder(place);
  const auto& journal = run_.journal().records();
  const json* preparing = last_record(journal, "stage-preparing", place.episode, place.kind, place.attempt);
  ensure_task(task, stage_task(place.kind, place.episode, campaign_in_force(), run_.campaign_hash(), inputs, task),
              preparing != nullptr ? preparing->value("task_hash", "") : "");
  // What an earlier start complained of (a full disk, say) is in the journal; this start may do better.
  std::filesystem::remove(task / "failure.json");
  const CaseCondition condition = case_condition(journal, place.episode, place.kind, place.attempt, task, ranks());
  if (condition == CaseCondition::ready) return 0;
  if (condition == CaseCondition::damaged) {
    view_.say(fmt::format("{}: {} was damaged or changed after it was prepared; it is prepared again", name_of(place),
                          (task / "foam").string()));
    std::filesystem::remove_all(task / "foam");
  }
  Command command = launcher_.prepare(place.kind, task);
  command.words.insert(command.words.end(), {"--ranks", std::to_string(ranks())});
  const int status =
      run_to_end(place, command, "stage-preparing", {{"task_hash", hash_file(task / "task.yaml")}}, false);
  if (status != 0) return status;
  json content = about(place);
  content["ranks"] = ranks();
  content["case_hash"] = case_fingerprint(task / "foam");
  run_.journal().append("stage-prepared", content);
  return 0;
}

int StageRunner::run_to_end(const StagePlace& place, Command command, const std::string& event, json content,
                            bool stoppable) {
  command.environment.emplace(stderr_goes_to_log, "1");
  ChildProcess process(command, signals_.former_mask());
  const ProcessIdentity identity = ProcessIdentity::of(process.pid());
  content.update(about(place));
  content["host"] = identity.host;
  content["pid"] = identity.pid;
  content["process_started"] = identity.started;
  run_.journal().append(event, content);
  const auto begin = std::chrono::steady_clock::now();
  process.release();
  int passed_on = 0;
  for (;;) {
    if (const auto status = process.poll()) {
      waited_ += std::chrono::steady_clock::now() - begin;
      return *status;
    }
    signals_.wait(look_again);
    view_.show(progress_line(place, read_progress(folder(place))));
    // Every request is passed on: the first may have come before the stage could hear it.
    if (const int asked = signals_.stop_requests(); stoppable && asked > passed_on) {
      view_.say(passed_on == 0 ? "stopping: the stage ends its block and writes a checkpoint"
                               : "already stopping: waiting for the stage's checkpoint");
      passed_on = asked;
      process.signal(SIGUSR1);
    }
  }
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
                  fmt::format("{}: {} ({})", name_of(place), sentence_of(*failure), task.string()));
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
  while (std::chrono::steady_clock::now() < until && signals_.stop_requests() == 0) signals_.wait(look_again);
  // The other ranks may still be on their way out.
  for (int tenths = 0; tenths < 50 && FolderLock::holder(task); ++tenths) std::this_thread::sleep_for(100ms);
}

int StageRunner::ranks() const { return ranks_in_force(run_.journal().records(), run_.campaign().launch.ranks); }

Campaign StageRunner::campaign_in_force() const {
  Campaign campaign = run_.campaign();
  for (const auto& [key, value] : advice_taken(run_.journal().records()))
    campaign = with_changed_key(campaign, key, value);
  campaign.launch.ranks = ranks();
  return campaign;
}

}  // namespace cupola
