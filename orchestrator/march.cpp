#include "orchestrator/march.hpp"

#include <fmt/format.h>
#include <sys/resource.h>

#include <chrono>
#include <string>
#include <vector>

#include "orchestrator/convergence.hpp"
#include "orchestrator/convergence_rules.hpp"
#include "orchestrator/episode_judgement.hpp"
#include "orchestrator/prediction_judgement.hpp"
#include "orchestrator/quantity_text.hpp"
#include "orchestrator/stage_orders.hpp"
#include "orchestrator/stage_runner.hpp"
#include "orchestrator/stage_state.hpp"

namespace cupola {
namespace {

using nlohmann::json;
constexpr const char* on_request = "on request";
constexpr const char* after_one_stage = "after one stage, as asked for";

std::string change_text(const json& judgement, const Campaign& campaign) {
  std::string text;
  for (const ConvergenceRule& rule : convergence_rules()) {
    if (!rule.applies(campaign)) continue;
    const json& change = judgement["change"][rule.name];
    text += fmt::format("{}{} {}", text.empty() ? "" : ", ", rule.name,
                        change.is_null() ? "not known" : fmt::format("{:.3g}", change.get<double>()));
  }
  return text;
}

/// The march's own state, derived from the run folder while it goes.
class March {
 public:
  March(RunFolder& run, const StageLauncher& launcher, SignalWatch& signals, ProgressView& view,
        const MarchOptions& options, const AfterStage& after_stage)
      : run_(run),
        stages_(run, launcher, signals, view, options.stop_within),
        view_(view),
        options_(options),
        after_stage_(after_stage),
        limit_(options.at_most.value_or(run.campaign().converged.at_most)) {}

  ExitCode go() {
    if (const auto why = finish_first_prediction()) return stop(*why);
    for (int episode = 1; episode <= limit_; ++episode) {
      if (const auto why = finish_episode(episode)) return stop(*why);
      const Verdict now = judge(episode);
      if (now != Verdict::not_yet) return end(now, episode);
      if (episode < limit_ && enough_for_once()) return stop(after_one_stage);
      if (options_.until_episode && episode >= *options_.until_episode && episode < limit_)
        return stop(fmt::format("after episode {}, as asked for", episode));
    }
    return end(Verdict::not_yet, limit_);
  }

 private:
  /// @return why it has not been finished; none: it has
  std::optional<std::string> finish_episode(int episode) {
    const std::vector<TaskKind>& stages = stages_of_episode(run_.campaign().strategy);
    EpisodeFolders now;
    for (const TaskKind kind : stages) {
      const auto order = stage_order(kind, finished_, now, run_.path(), run_.campaign());
      if (!order) continue;
      const StagePlace place{episode, limit_, kind, 1};
      if (!can_be_left_out(kind)) {
        const auto folder = stages_.finish(place, *order);
        if (!folder) return on_request;
        (kind == TaskKind::dem ? now.dem : now.tracer) = *folder;
      } else if (!finish_or_do_without(place, *order, kind == TaskKind::predict ? now.predict : now.correct)) {
        return on_request;
      }
      if (kind == stages.back()) break;
      after_stage_();
      if (enough_for_once()) return after_one_stage;
    }
    finished_.push_back(now);
    return std::nullopt;
  }

  /// A prediction or correction, without which the campaign can go on marching.
  /// @param folder set where it has succeeded  @return false where a stop was asked for
  bool finish_or_do_without(const StagePlace& place, const StageOrder& order,
                            std::optional<std::filesystem::path>& folder) {
    const auto state = stage_state(run_.path(), run_.journal().records(), place.episode, place.kind);
    if (state.condition == StageState::Condition::failed) return true;  // it would fail again
    try {
      folder = stages_.finish(place, order);
      return folder.has_value();
    } catch (const Failure& failure) {
      if (failure.code() != ExitCode::diverged) throw;
      view_.say(fmt::format("{} The campaign goes on marching.", failure.what()));
      return true;
    }
  }

  /// The prediction that `predict-and-verify` begins with. @return why it has not been finished
  std::optional<std::string> finish_first_prediction() {
    if (run_.campaign().strategy != Strategy::predict_and_verify) return std::nullopt;
    std::optional<std::filesystem::path> folder;
    if (!finish_or_do_without({before_all_episodes, limit_, TaskKind::predict, 1}, {}, folder)) return on_request;
    after_stage_();
    if (enough_for_once()) return after_one_stage;
    return std::nullopt;
  }

  /// Whether the one stage that was asked for has ended while we worked here.
  [[nodiscard]] bool enough_for_once() const {
    return options_.one_stage && stages_finished(run_.journal().records()) > finished_before_;
  }

  /// Judges the episode, or takes what an earlier orchestrator wrote down.
  Verdict judge(int episode) {
    json judgement;
    for (const json& record : run_.journal().records())
      if (record.value("event", "") == "episode-judged" && record.value("episode", 0) == episode) judgement = record;
    if (judgement.is_null()) {
      judgement = finished_.back().correct
                      ? judge_prediction(finished_, softened_by(finished_, run_.path()), run_.campaign())
                      : judge_episode(finished_, run_.campaign());
      run_.journal().append("episode-judged", judgement);
      view_.say(fmt::format("episode {}: change over criterion: {}", episode, change_text(judgement, run_.campaign())));
    }
    met_.push_back(judgement.value("met", false));
    after_stage_();
    const double unmelted = judgement.value("unmelted_share", 0.);
    if (!is_verified(judgement)) return verdict(met_, run_.campaign().converged.for_episodes, unmelted);
    return verified_verdict(met_.back(), unmelted);
  }

  ExitCode stop(const std::string& why) {
    run_.journal().append("orchestrator-stopped", {{"why", why}, {"own", own_share()}});
    after_stage_();
    view_.say(fmt::format("stopped {}. `cupola resume {}` goes on.", why, run_.path().string()));
    return ExitCode::stopped;
  }

  ExitCode end(Verdict verdict, int episode) {
    const ExitCode code = verdict == Verdict::converged ? ExitCode::done : ExitCode::stopped;
    const json content = {
        {"outcome", to_text(verdict)}, {"episodes", episode}, {"status", static_cast<int>(code)}, {"own", own_share()}};
    const json& last = run_.journal().records().back();
    const bool known = last.value("event", "") == "campaign-ended" && last.value("episodes", 0) == episode;
    if (!known) run_.journal().append("campaign-ended", content);
    after_stage_();
    std::string sentence = fmt::format("{} after {}", to_text(verdict), counted(episode, "episode"));
    if (verdict == Verdict::not_yet)
      sentence +=
          fmt::format(", its limit. `cupola resume {} --at-most {}` goes on", run_.path().string(), 2 * episode);
    view_.say(fmt::format("{}: {}.", run_.campaign().name, sentence));
    return code;
  }

  /// What this orchestrator took for itself: wall time without that of the stages, and processor time.
  json own_share() const {
    const std::chrono::duration<double> wall = std::chrono::steady_clock::now() - begun_;
    rusage usage{};
    ::getrusage(RUSAGE_SELF, &usage);
    const auto seconds = [](const timeval& time) {
      return static_cast<double>(time.tv_sec) + 1e-6 * static_cast<double>(time.tv_usec);
    };
    return {{"wall_seconds", (wall - stages_.waited()).count()},
            {"cpu_seconds", seconds(usage.ru_utime) + seconds(usage.ru_stime)},
            {"of_wall_seconds", wall.count()}};
  }

  std::chrono::steady_clock::time_point begun_ = std::chrono::steady_clock::now();
  RunFolder& run_;
  StageRunner stages_;
  ProgressView& view_;
  MarchOptions options_;
  const AfterStage& after_stage_;
  int limit_;
  std::vector<EpisodeFolders> finished_;
  std::vector<bool> met_;
  int finished_before_ = stages_finished(run_.journal().records());
};

}  // namespace

ExitCode march(RunFolder& run, const StageLauncher& launcher, SignalWatch& signals, ProgressView& view,
               const MarchOptions& options, const AfterStage& after_stage) {
  return March(run, launcher, signals, view, options, after_stage).go();
}

}  // namespace cupola
