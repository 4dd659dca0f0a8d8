#include <spdlog/spdlog.h>

#include <algorithm>
#include <cmath>

#include "stage_tracer/tracer_stage.hpp"

/// What the steps cost in accuracy, and when the march is there.
namespace cupola {
namespace {

constexpr int windows_in_a_row = 2;  // that must agree before a march is ended
/// Steps of twice the length that are compared with the march, where there is room for them.
constexpr long most_pairs = 4;
constexpr long steps_before_trial = 4;
constexpr long least_steps_for_usual_trials = 16;
/// Where a trial has changed nothing the next one is made after this many times as many steps.
constexpr long patience = 3;
/// Part of the accuracy asked for that the step may cost; the rest is the flow's lag and the noise of the tracers.
constexpr double part_of_accuracy = 0.7;
constexpr double most_growth = 2;
constexpr double most_shrinkage = 0.1;
constexpr double worth_a_change = 0.15;

}  // namespace

struct TracerStage::Snapshot {
  long step;
  double now;
  Tracers tracers;
  Ledger ledger;
  Averages averages;
  Tally tally;
  std::int64_t held_back, cells_at_floor;
  std::optional<Insertion::State> insertion{};
  std::optional<GasModel::State> gas{};
};

TracerStage::Snapshot TracerStage::snapshot() const {
  Snapshot kept{step_, now_, tracers_, ledger_, averages_, local_tally_, held_back_, cells_at_floor_};
  if (insertion_) kept.insertion = insertion_->state();
  if (gas_) kept.gas = gas_->state();
  return kept;
}

void TracerStage::go_back_to(Snapshot kept) {
  step_ = kept.step;
  now_ = kept.now;
  tracers_ = std::move(kept.tracers);
  ledger_ = kept.ledger;
  averages_ = std::move(kept.averages);
  local_tally_ = kept.tally;
  held_back_ = kept.held_back;
  cells_at_floor_ = kept.cells_at_floor;
  if (insertion_) insertion_->restore(std::move(*kept.insertion));
  if (gas_) gas_->restore(std::move(*kept.gas));
}

SolidsState TracerStage::solids_now() const {
  const CellContents contents = sum_tracers(tracers_, campaign_.species.size(), mesh_.cells(), true, sum_);
  return {spread(contents, kernel_), campaign_};
}

void TracerStage::begin_trial() {
  if (!campaign_.heat || trial_) return;
  // A short march has its first trial early.
  const long first = steps_.count < least_steps_for_usual_trials ? steps_.count / 4 : steps_before_trial;
  const long pairs = std::min(most_pairs, (steps_.count - step_) / 2);
  if (step_ < std::max(first, next_trial_) || pairs < 1) return;
  const auto running = clock_.measure("error estimate");
  const auto parts = clock_.seconds();
  Snapshot kept = snapshot();
  StepTrial trial{step_, pairs, {}, {}};
  for (long pair = 0; pair < pairs; ++pair, step_ += 2) {
    advance(2 * steps_.length);
    if (pair == 0) trial.early = solids_now();
  }
  trial.late = solids_now();
  go_back_to(std::move(kept));
  trial_ = std::move(trial);
  clock_.restore(parts);
}

void TracerStage::judge_trial() {
  if (!trial_ || step_ < trial_->begin + 2) return;
  const bool first = step_ == trial_->begin + 2;
  const bool last = step_ == trial_->begin + 2 * trial_->pairs;
  if (!first && !last) return;
  const auto running = clock_.measure("error estimate");
  const SolidsState reached = solids_now();
  if (first) early_difference_ = temperature_difference(trial_->early, reached);
  if (!last) return;
  step_error_ = {steps_.length, early_difference_, temperature_difference(trial_->late, reached),
                 2 * static_cast<double>(trial_->pairs) * steps_.length, heat_.relaxation_time(contents_)};
  trial_.reset();
  next_trial_ = choose_step() ? step_ + steps_before_trial : patience * step_;
}

bool TracerStage::choose_step() {
  const double duration = campaign_.tracer.longest();
  const double error = step_error_.after(duration, steps_.length);
  if (foam_.rank() == 0) {
    spdlog::info(
        "after {} steps, of {:.4g} s: half as many of twice the length differ by {:.2g} after {:.4g} s, growing with "
        "time to the {:.2g}; estimated error {:.2g}",
        step_, steps_.length, step_error_.late, step_error_.seconds, step_error_.growth(), error);
  }
  if (campaign_.tracer.time_step || step_ >= steps_.count) return false;
  const double wanted = error > 0 ? part_of_accuracy * campaign_.tracer.accuracy / error : most_growth;
  const double length =
      std::clamp(steps_.length * std::clamp(wanted, most_shrinkage, most_growth), limits_.shortest, limits_.longest);
  if (std::abs(length / steps_.length - 1) < worth_a_change) return false;
  const TimeSteps rest = fill_with_steps(duration - now_, length);
  steps_ = {step_ + rest.count, rest.length};
  if (foam_.rank() == 0) spdlog::info("the step becomes {:.4g} s", steps_.length);
  return true;
}

void TracerStage::end_window() {
  // Windows end where the march ends.
  const auto windows_left = [&](double time) {
    return std::ceil((campaign_.tracer.longest() - time) / window() - 1e-6);
  };
  const bool last = step_ >= steps_.count;
  if (!last && windows_left(now_ - steps_.length) == windows_left(now_)) return;
  const auto running = clock_.measure("averages");
  windows_->add(averages_);
  if (!last) averages_.clear();
}

bool TracerStage::is_steady() {
  if (campaign_.tracer.stop != TracerSettings::Stop::steady) return false;
  // Windows end where the longest march would end.
  const auto windows_left = [&](double time) {
    return std::floor((campaign_.tracer.longest() - time) / window() + 1e-9);
  };
  if (windows_left(now_ - steps_.length) == windows_left(now_) || step_ == steps_.count) return false;
  if (averages_.seconds() < 0.9 * window()) {  // the first window is cut short
    averages_.clear();
    return false;
  }
  const auto running = clock_.measure("averages");
  auto [capacity, temperature] = averages_.solids(campaign_);
  for (std::size_t c = 0; c < capacity.size(); ++c) {
    if (field_.stagnant[c]) capacity[c] = 0;
  }
  steady_.add(capacity, temperature);
  if (steady_.below(campaign_.tracer.remaining_change) >= windows_in_a_row) return true;
  averages_.clear();
  return false;
}

}  // namespace cupola
