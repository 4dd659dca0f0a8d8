#pragma once
#include <optional>
#include <string>
#include <vector>

/// When a campaign has converged (MODEL 18): pure functions of numbers, no files.
///
/// Episodes k = 1, 2, … give fields T_k. If the alternation contracts by a factor lambda an episode, what is still to
/// come after episode k is the rest of a geometric series, d_(k+1) + d_(k+2) + … = lambda/(1 - lambda) d_k with d_k =
/// T_k - T_(k-1). A flat curve proves nothing: with lambda = 0.9 the remaining change is nine times the last one.
namespace cupola {

/// The contraction of an alternation as its last two steps show it.
struct Contraction {
  double lambda = 0;        ///< <d_k, d_(k-1)> / <d_(k-1), d_(k-1)>; infinite where only d_(k-1) vanishes
  double factor = 0;        ///< remaining change over |d_k|
  bool contracting = true;  ///< false where |lambda| is above `largest_lambda`: no limit in sight
};

/// Below this a measured lambda counts as this: two steps cannot prove a faster contraction.
inline constexpr double smallest_lambda = 0.3;
/// Above this the alternation does not count as contracting.
inline constexpr double largest_lambda = 0.95;

/// Measures lambda in the weighted inner product <a, b> = sum_i w_i a_i b_i.
/// @param last d_k, @param before d_(k-1), @param weights not negative; all of one length
Contraction contraction(const std::vector<double>& last, const std::vector<double>& before,
                        const std::vector<double>& weights);

/// sqrt(sum_i w_i a_i^2 / sum_i w_i); 0 where all weights vanish.
double weighted_rms(const std::vector<double>& values, const std::vector<double>& weights);

/// What one rule says about one episode.
struct Judgement {
  double change = 0;             ///< figure over its criterion: below 1 = met
  double figure = 0;             ///< remaining change in the unit of the criterion
  std::optional<double> lambda;  ///< where the rule extrapolates and three episodes are there
  bool met = false;              ///< change below 1 and measured well enough to say so
};

/// The remaining change of a series of which the last two or three members are known.  With two members no contraction
/// is known: the figure is the last change itself and the rule cannot be met.  Without contraction it is not met
/// either, and the change is at least 1.
/// @param scale what a change of rms 1 is in the unit of the criterion
Judgement judge_remaining_change(const std::vector<double>& now, const std::vector<double>& before,
                                 const std::optional<std::vector<double>>& two_before,
                                 const std::vector<double>& weights, double scale, double criterion);

/// Remaining change of the temperature field over rms(T - 293 K).
/// @param now, before, two_before K in cells; @param weights heat capacity of the solids a cell, J/K, 0 where a cell
/// does not count
Judgement judge_temperature(const std::vector<double>& now, const std::vector<double>& before,
                            const std::optional<std::vector<double>>& two_before, const std::vector<double>& weights,
                            double criterion);

/// Remaining change of the cohesive zone's height, in cells, rms over the columns.  A column without the zone (NaN)
/// counts as one whose zone has sunk to the lowest height found, so that a zone that comes or goes is seen as a move.
/// @param now, before, two_before m by column; @param areas m2 by column; @param cell m; @param criterion cells
/// @return not met, with an infinite change, where no column has a zone in one of the episodes
Judgement judge_cohesive_zone(const std::vector<double>& now, const std::vector<double>& before,
                              const std::optional<std::vector<double>>& two_before, const std::vector<double>& areas,
                              double cell, double criterion);

/// Difference of two measured velocity fields in units of their combined standard error: rms over cells and components
/// of the difference over the rms of sqrt(e_1^2 + e_2^2).  Both are pooled before they are divided: a cell whose few
/// samples happen to agree has an estimated error near zero and would decide alone otherwise.
/// @param difference, combined_error m/s, three components a cell; @param weights by cell
Judgement judge_granular_velocity(const std::vector<double>& difference, const std::vector<double>& combined_error,
                                  const std::vector<double>& weights, double criterion);

/// How a campaign stands after an episode.
enum class Verdict {
  not_yet,
  converged,
  steady_ore_not_melted,  ///< everything has settled, but more than 5 % of the charge leaves as unmelted ore (MODEL 4)
};

/// Least number of episodes of a converged campaign.
inline constexpr int least_episodes = 3;
/// Greatest share of the charge that may leave unmelted in a converged campaign.
inline constexpr double greatest_unmelted_share = 0.05;

/// @param all_met for each episode so far, whether all its rules were met
/// @param in_a_row how many episodes on end must meet them
Verdict verdict(const std::vector<bool>& all_met, int in_a_row, double unmelted_share);
/// Of an episode whose march has verified its prediction. @param met whether all its rules were met
Verdict verified_verdict(bool met, double unmelted_share);

std::string to_text(Verdict verdict);

}  // namespace cupola
