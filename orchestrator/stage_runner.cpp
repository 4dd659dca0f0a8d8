#include "orchestrator/stage_runner.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <chrono>

#include "orchestrator/campaign_difference.hpp"
#include "orchestrator/prepared_case.hpp"
#include "orchestrator/quantity_text.hpp"
#include "orchestrator/result_check.hpp"
#include "orchestrator/run_check.hpp"
#include "orchestrator/stage_task.hpp"
#include "physics/stage/stage_log.hpp"

namespace cupola {
namespace {

using nlohmann::json;
using Condition = StageState::Condition;
using namespace std::chrono_literals;

constexpr auto look_again = 500ms;  // at progress.json

}  // namespace

std::string StageRunner::name_of(const StagePlace& place) { return stage_title(place.kind, place.episode); }

std::filesystem::path StageRunner::folder(const StagePlace& place) const {
  return task_folder(run_.path(), place.episode, place.kind, place.attempt);
}

json StageRunner::about(const StagePlace& place) const {
  return {{"episode", place.episode}, {"stage", stage_name(place.kind)}, {"attempt", place.attempt}};
}

std::optional<std::filesystem::path> StageRunner::finish(StagePlace place, const StageOrder& order) {
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
    begin_anew_where_removed(place);
    switch (state.condition) {
      case Condition::running:
        wait_for_orphan(place, state);
        break;
      case Condition::failed:
        begin_retry(place, state, patience);
        break;
      default:
        if (!run_attempt(place, order, patience)) return std::nullopt;
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
      throw Failure(failure.code(), still_whole(run_.path(), failure.what()));
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

void StageRunner::begin_anew_where_removed(const StagePlace& place) {
  if (std::filesystem::exists(folder(place)) ||
      last_record(run_.journal().records(), "stage-preparing", place.episode, place.kind, place.attempt) == nullptr)
    return;
  std::vector<std::string> later;
  bool after = false;
  for (const TaskKind kind : all_stages_of_episode()) {
    const auto other = stage_folder(run_.path(), place.episode, kind);
    if (after && place.episode != before_all_episodes && std::filesystem::exists(other))
      later.push_back(other.string());
    after = after || kind == place.kind;
  }
  for (int episode = place.episode + 1;; ++episode) {
    const auto next = stage_folder(run_.path(), episode, TaskKind::dem).parent_path();
    if (!std::filesystem::exists(next)) break;
    later.push_back(next.string());
  }
  if (!later.empty())
    throw Failure(ExitCode::input_output,
                  fmt::format("{}: removed, and what comes after it was made from it. Put it back from a copy, or move "
                              "these away too and resume: {}.",
                              folder(place).string(), fmt::join(later, ", ")));
  run_.journal().append("stage-begun-anew", about(place));
  view_.say(fmt::format("{}: its folder was removed; it begins anew", name_of(place)));
}

void StageRunner::wait_for_orphan(const StagePlace& place, const StageState& state) {
  view_.say(fmt::format("{}: still runs ({}); waiting for it", name_of(place),
                        state.process ? fmt::format("mpirun is process {}", state.process->pid)
                                      : FolderLock::holder(state.folder).value_or("it is just ending")));
  run_.journal().append("orphan-found", about(place));
  int passed_on = 0;
  const auto begin = std::chrono::steady_clock::now();
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
  waited_ += std::chrono::steady_clock::now() - begin;
}

bool StageRunner::run_attempt(const StagePlace& place, const StageOrder& order, Patience& patience) {
  ++patience.starts;
  const std::filesystem::path task = folder(place);
  make_task(place, order);
  Launch launch = run_.campaign().launch;
  launch.ranks = ranks();
  if (launch.slurm && !in_allocation_for(launch.ranks)) {
    const auto begin = std::chrono::steady_clock::now();
    const JobEnd end = jobs_.run(place);
    waited_ += std::chrono::steady_clock::now() - begin;
    return judge_job(place, end, patience);
  }
  if (const int status = make_ready(place); status != 0) return judge_end(place, status, patience);
  if (signals_.stop_requests() > 0) return false;
  const int status =
      run_to_end(place, launcher_.run(place.kind, task, launch), "stage-started", {{"ranks", launch.ranks}}, true);
  return judge_end(place, status, patience);
}

void StageRunner::make_task(const StagePlace& place, const StageOrder& order) {
  const std::filesystem::path task = folder(place);
  const json* preparing =
      last_record(run_.journal().records(), "stage-preparing", place.episode, place.kind, place.attempt);
  Campaign campaign = campaign_in_force();
  campaign.tracer.duration = order.tracer_duration.value_or(campaign.tracer.duration);
  ensure_task(task, stage_task(place.kind, place.episode, campaign, run_.campaign_hash(), order.inputs, task),
              preparing != nullptr ? preparing->value("task_hash", "") : "");
  // What an earlier start complained of (a full disk, say) is in the journal; this start may do better.
  std::filesystem::remove(task / "failure.json");
}

int StageRunner::make_ready(const StagePlace& place) {
  const std::filesystem::path task = folder(place);
  const auto& journal = run_.journal().records();
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
  auto deadline = std::chrono::steady_clock::time_point::max();
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
      if (passed_on == 0)
        deadline = std::chrono::steady_clock::now() +
                   std::chrono::duration_cast<std::chrono::steady_clock::duration>(stop_within_);
      passed_on = asked;
      process.signal(SIGUSR1);
    }
    if (std::chrono::steady_clock::now() > deadline) {
      view_.say(
          fmt::format("{}: has not left {} after it was asked to; it is killed, and goes on from its last checkpoint",
                      name_of(place), duration_text(stop_within_.count())));
      process.kill_all();
      deadline = std::chrono::steady_clock::time_point::max();
    }
  }
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
