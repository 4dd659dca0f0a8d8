#include "orchestrator/convergence.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>

#include "physics/closures/enthalpy_zero.hpp"

namespace cupola {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

std::vector<double> difference(const std::vector<double>& a, const std::vector<double>& b) {
  if (a.size() != b.size()) throw std::invalid_argument("fields of two episodes differ in length");
  std::vector<double> result(a.size());
  std::transform(a.begin(), a.end(), b.begin(), result.begin(), std::minus<>());
  return result;
}

double inner_product(const std::vector<double>& a, const std::vector<double>& b, const std::vector<double>& weights) {
  double sum = 0;
  for (std::size_t i = 0; i < weights.size(); ++i) sum += weights[i] * a[i] * b[i];
  return sum;
}

double lowest(const std::vector<double>& heights) {
  double result = infinity;
  for (const double height : heights)
    if (std::isfinite(height)) result = std::min(result, height);
  return result;
}

std::vector<double> without_gaps(std::vector<double> heights, double instead) {
  std::replace_if(
      heights.begin(), heights.end(), [](double height) { return !std::isfinite(height); }, instead);
  return heights;
}

}  // namespace

Contraction contraction(const std::vector<double>& last, const std::vector<double>& before,
                        const std::vector<double>& weights) {
  Contraction result;
  const double across = inner_product(last, before, weights);
  const double square = inner_product(before, before, weights);
  if (square > 0)
    result.lambda = across / square;
  else
    result.lambda = inner_product(last, last, weights) > 0 ? infinity : 0.;
  result.contracting = std::abs(result.lambda) <= largest_lambda;
  // An alternation that swings (lambda < 0) leaves |lambda|/(1 - lambda) of its last step.
  const double bounded = std::clamp(result.lambda, -largest_lambda, largest_lambda);
  result.factor = std::max(smallest_lambda / (1 - smallest_lambda), std::abs(bounded) / (1 - bounded));
  return result;
}

double weighted_rms(const std::vector<double>& values, const std::vector<double>& weights) {
  double sum = 0, total = 0;
  for (std::size_t i = 0; i < weights.size(); ++i) {
    sum += weights[i] * values[i] * values[i];
    total += weights[i];
  }
  return total > 0 ? std::sqrt(sum / total) : 0.;
}

Judgement judge_remaining_change(const std::vector<double>& now, const std::vector<double>& before,
                                 const std::optional<std::vector<double>>& two_before,
                                 const std::vector<double>& weights, double scale, double criterion) {
  const std::vector<double> last = difference(now, before);
  Judgement judgement;
  judgement.figure = scale * weighted_rms(last, weights);
  bool measured = false;
  if (two_before) {
    const Contraction step = contraction(last, difference(before, *two_before), weights);
    judgement.lambda = step.lambda;
    judgement.figure *= step.factor;
    measured = step.contracting;
  }
  judgement.change = judgement.figure / criterion;
  if (two_before && !measured) judgement.change = std::max(judgement.change, 1.);
  judgement.met = measured && judgement.change < 1;
  return judgement;
}

Judgement judge_temperature(const std::vector<double>& now, const std::vector<double>& before,
                            const std::optional<std::vector<double>>& two_before, const std::vector<double>& weights,
                            double criterion) {
  std::vector<double> excess = now;
  for (double& value : excess) value -= enthalpy_zero;
  constexpr double least_level = 1e-9;  // K: a bed at 293 K everywhere has no level to compare with
  const double level = std::max(weighted_rms(excess, weights), least_level);
  return judge_remaining_change(now, before, two_before, weights, 1 / level, criterion);
}

Judgement judge_cohesive_zone(const std::vector<double>& now, const std::vector<double>& before,
                              const std::optional<std::vector<double>>& two_before, const std::vector<double>& areas,
                              double cell, double criterion) {
  const double lowest_now = lowest(now), lowest_before = lowest(before);
  double bottom = std::min(lowest_now, lowest_before);
  bool zone_everywhere = std::isfinite(lowest_now) && std::isfinite(lowest_before);
  if (two_before) {
    const double lowest_first = lowest(*two_before);
    bottom = std::min(bottom, lowest_first);
    zone_everywhere = zone_everywhere && std::isfinite(lowest_first);
  }
  if (!zone_everywhere) return {.change = infinity, .figure = infinity, .lambda = std::nullopt, .met = false};
  std::optional<std::vector<double>> first;
  if (two_before) first = without_gaps(*two_before, bottom);
  return judge_remaining_change(without_gaps(now, bottom), without_gaps(before, bottom), first, areas, 1 / cell,
                                criterion);
}

Judgement judge_granular_velocity(const std::vector<double>& difference, const std::vector<double>& combined_error,
                                  const std::vector<double>& weights, double criterion) {
  if (difference.size() != 3 * weights.size() || combined_error.size() != difference.size())
    throw std::invalid_argument("velocity fields need three components a cell");
  std::vector<double> by_component(difference.size());
  for (std::size_t i = 0; i < by_component.size(); ++i) by_component[i] = weights[i / 3];
  const double change = weighted_rms(difference, by_component);
  const double error = weighted_rms(combined_error, by_component);
  Judgement judgement;
  if (change > 0) judgement.figure = error > 0 ? change / error : infinity;
  judgement.change = judgement.figure / criterion;
  judgement.met = judgement.change < 1;
  return judgement;
}

Verdict verdict(const std::vector<bool>& all_met, int in_a_row, double unmelted_share) {
  const auto episodes = static_cast<int>(all_met.size());
  if (episodes < least_episodes || episodes < in_a_row) return Verdict::not_yet;
  if (!std::all_of(all_met.end() - in_a_row, all_met.end(), [](bool met) { return met; })) return Verdict::not_yet;
  return verified_verdict(true, unmelted_share);
}

Verdict verified_verdict(bool met, double unmelted_share) {
  if (!met) return Verdict::not_yet;
  return unmelted_share > greatest_unmelted_share ? Verdict::steady_ore_not_melted : Verdict::converged;
}

std::string to_text(Verdict verdict) {
  switch (verdict) {
    case Verdict::converged:
      return "converged";
    case Verdict::steady_ore_not_melted:
      return "steady, ore not melted";
    case Verdict::not_yet:
      break;
  }
  return "not yet converged";
}

}  // namespace cupola
