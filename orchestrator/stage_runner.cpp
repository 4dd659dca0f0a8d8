#include "orchestrator/stage_runner.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <chrono>
#include <thread>

#include "orchestrator/campaign_difference.hpp"
#include "orchestrator/quantity_text.hpp"
#include "orchestrator/result_check.hpp"
#include "orchestrator/stage_task.hpp"

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

bool was_prepared(const std::vector<json>& journal, const StagePlace& place, const std::filesystem::path& folder) {
  if (!std::filesystem::exists(folder / "foam" / "mesh.hdf")) return false;
  for (const json& record : journal)
    if (record.value("event", "") == "stage-prepared" && is_about(record, place.episode, place.kind, place.attempt))
      return true;
  return false;
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
    if (const auto end = jobs_.find_again(place)) {
      if (!judge_job(place, *end, patience)) return std::nullopt;
      continue;
    }
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
                      "Put the folder back, or begin a new run.",
                      (state.folder / "manifest.json").string(), name_of(place)));
    verify_manifest(state.folder);
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
    Campaign changed = campaign_with_advice();
    for (const auto& [key, value] : changes) changed = with_changed_key(changed, key, value);
  }
  place.attempt = state.attempt + 1;
  json content = about(place);
  content["because"] = sentence;
  content["changes"] = changes;
  run_.journal().append("advice-taken", content);
  std::vector<std::string> words;
  for (const auto& [key, value] : changes) words.push_back(key + " = " + value);
  view_.say(fmt::format("{}: {}\n  tried again{}{}", name_of(place), sentence, words.empty() ? "" : " with ",
                        fmt::join(words, ", ")));
  std::filesystem::create_directories(folder(place));
}

bool StageRunner::run_attempt(const StagePlace& place, const std::map<std::string, std::filesystem::path>& inputs,
                              Patience& patience) {
  ++patience.starts;
  const std::filesystem::path task = folder(place);
  ensure_task(task, stage_task(place.kind, place.episode, campaign_with_advice(), run_.campaign_hash(), inputs, task));
  // What an earlier start complained of (a full disk, say) is in the journal; this start may do better.
  std::filesystem::remove(task / "failure.json");
  const Launch& launch = run_.campaign().launch;
  if (launch.slurm && !in_allocation_for(launch.ranks)) return judge_job(place, jobs_.run(place), patience);
  if (!was_prepared(run_.journal().records(), place, task)) {
    const int status = run_to_end(place, launcher_.prepare(place.kind, task), "stage-preparing", false);
    if (status != 0) return judge_end(place, status, patience);
    run_.journal().append("stage-prepared", about(place));
    if (signals_.stop_requests() > 0) return false;
  }
  const int status = run_to_end(place, launcher_.run(place.kind, task, launch), "stage-started", true);
  return judge_end(place, status, patience);
}

int StageRunner::run_to_end(const StagePlace& place, const Command& command, const std::string& event, bool stoppable) {
  ChildProcess process(command, signals_.former_mask());
  const ProcessIdentity identity = ProcessIdentity::of(process.pid());
  json content = about(place);
  content["host"] = identity.host;
  content["pid"] = identity.pid;
  content["process_started"] = identity.started;
  run_.journal().append(event, content);
  process.release();
  int passed_on = 0;
  for (;;) {
    if (const auto status = process.poll()) return *status;
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
  run_.journal().append("stage-died", content);
  if (++patience.deaths > 1)
    throw Failure(ExitCode::diverged,
                  fmt::format("{}: ended without saying why (status {}) and did so again; see {}. `cupola resume` goes "
                              "on from its checkpoint.",
                              name_of(place), status, (task / "stage.log").string()));
  view_.say(fmt::format("{}: ended without saying why (status {}); started again from its checkpoint", name_of(place),
                        status));
  // The other ranks may still be on their way out.
  for (int tenths = 0; tenths < 50 && FolderLock::holder(task); ++tenths) std::this_thread::sleep_for(100ms);
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

Campaign StageRunner::campaign_with_advice() const {
  Campaign campaign = run_.campaign();
  for (const auto& [key, value] : advice_taken(run_.journal().records()))
    campaign = with_changed_key(campaign, key, value);
  return campaign;
}

}  // namespace cupola
