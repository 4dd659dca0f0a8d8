#include "orchestrator/convergence.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace {

using cupola::contraction;
using cupola::judge_cohesive_zone;
using cupola::judge_granular_velocity;
using cupola::judge_temperature;
using cupola::Verdict;
using cupola::verdict;
using Field = std::vector<double>;

constexpr double none = std::numeric_limits<double>::quiet_NaN();

/// limit + amplitude * lambda^k, cell by cell.
Field geometric(const Field& limit, const Field& amplitude, double lambda, int k) {
  Field field(limit.size());
  for (std::size_t i = 0; i < limit.size(); ++i) field[i] = limit[i] + amplitude[i] * std::pow(lambda, k);
  return field;
}

const Field limit = {1293, 893, 593};
const Field amplitude = {-100, 50, 20};
const Field weights = {1, 2, 4};

/// The weighted distance from the limit after k episodes, in the criterion's unit: what the rule has to foretell.
double true_error(double lambda, int k) {
  Field error(limit.size()), excess = geometric(limit, amplitude, lambda, k);
  for (std::size_t i = 0; i < limit.size(); ++i) {
    error[i] = excess[i] - limit[i];
    excess[i] -= 293;
  }
  return cupola::weighted_rms(error, weights) / cupola::weighted_rms(excess, weights);
}

cupola::Judgement judged(double lambda, int k, double criterion) {
  return judge_temperature(geometric(limit, amplitude, lambda, k), geometric(limit, amplitude, lambda, k - 1),
                           geometric(limit, amplitude, lambda, k - 2), weights, criterion);
}

TEST(Contraction, IsTheRatioOfAGeometricSequence) {
  for (const double lambda : {0.3, 0.5, 0.9, 0.95}) {
    const auto step = contraction({lambda * 4, lambda * -2}, {4, -2}, {3, 1});
    EXPECT_NEAR(step.lambda, lambda, 1e-15);
    EXPECT_NEAR(step.factor, lambda / (1 - lambda), 1e-12);
    EXPECT_TRUE(step.contracting);
  }
}

TEST(Contraction, BelowTheSmallestCountsAsTheSmallest) {
  for (const double lambda : {0.29, 0.1, 0.0, -0.1}) {
    const auto step = contraction({lambda}, {1}, {1});
    EXPECT_DOUBLE_EQ(step.factor, 0.3 / 0.7);
    EXPECT_TRUE(step.contracting);
  }
}

TEST(Contraction, NoneWhereTheStepsGrowOrSwingWider) {
  for (const double lambda : {0.96, 1.0, 3.0, -0.96, -2.0}) EXPECT_FALSE(contraction({lambda}, {1}, {1}).contracting);
  EXPECT_FALSE(contraction({1}, {0}, {1}).contracting);
  EXPECT_TRUE(contraction({0}, {0}, {1}).contracting);
}

TEST(TemperatureRule, ForetellsTheErrorOfAGeometricSequence) {
  for (const double lambda : {0.4, 0.7, 0.9}) {
    for (const int k : {2, 5, 9}) {
      const auto judgement = judged(lambda, k, 0.01);
      EXPECT_NEAR(*judgement.lambda, lambda, 1e-9);
      EXPECT_NEAR(judgement.figure, true_error(lambda, k), 1e-9);
      EXPECT_NEAR(judgement.change, judgement.figure / 0.01, 1e-9);
      EXPECT_EQ(judgement.met, true_error(lambda, k) < 0.01);
    }
  }
}

TEST(TemperatureRule, IsNotFooledByAFlatCurve) {
  // Steps of 0.5 % of the level look small; with lambda = 0.94 sixteen times as much is still to come.
  const double lambda = 0.94;
  const Field start = {1000}, step = {5};
  const Field now = geometric({0}, step, lambda, 2), before = geometric({0}, step, lambda, 1), first = step;
  Field a = start, b = start, c = start;
  a[0] += first[0] + before[0] + now[0];
  b[0] += first[0] + before[0];
  c[0] += first[0];
  const auto judgement = judge_temperature(a, b, c, {1}, 0.01);
  EXPECT_LT((a[0] - b[0]) / (a[0] - 293), 0.01);
  EXPECT_GT(judgement.change, 1);
  EXPECT_FALSE(judgement.met);
}

TEST(TemperatureRule, CannotBeMetWithTwoEpisodes) {
  const auto judgement = judge_temperature({800}, {799.9}, std::nullopt, {1}, 0.01);
  EXPECT_FALSE(judgement.met);
  EXPECT_FALSE(judgement.lambda.has_value());
  EXPECT_NEAR(judgement.change, 0.1 / 507 / 0.01, 1e-9);
}

TEST(TemperatureRule, WithoutContractionIsNeverMet) {
  const auto judgement = judge_temperature({800.002}, {800.001}, Field{800}, {1}, 0.01);
  EXPECT_FALSE(judgement.met);
  EXPECT_GE(judgement.change, 1);
}

TEST(TemperatureRule, LeavesCellsOfNoWeightOut) {
  const auto judgement = judge_temperature({800, 400}, {800, 900}, Field{800, 1000}, {1, 0}, 0.01);
  EXPECT_EQ(judgement.figure, 0);
  EXPECT_TRUE(judgement.met);
}

TEST(CohesiveZoneRule, CountsInCells) {
  // Columns fall by 0.4, 0.2, 0.1, ... m: 0.1 m is still to come after the step of 0.1 m.
  const auto judgement = judge_cohesive_zone({2.3, 1.3}, {2.4, 1.4}, Field{2.6, 1.6}, {1, 3}, 0.2, 1);
  EXPECT_NEAR(*judgement.lambda, 0.5, 1e-12);
  EXPECT_NEAR(judgement.figure, 0.5, 1e-12);
  EXPECT_TRUE(judgement.met);
}

TEST(CohesiveZoneRule, SeesAZoneThatGoes) {
  const auto judgement = judge_cohesive_zone({2.5, none}, {2.5, 1.5}, Field{2.5, 1.5}, {1, 1}, 0.2, 1);
  EXPECT_EQ(judgement.figure, 0) << "the zone of the second column has sunk to the lowest height found, 1.5 m";
  const auto other = judge_cohesive_zone({none, 1.5}, {2.5, 1.5}, Field{2.5, 1.5}, {1, 1}, 0.2, 1);
  EXPECT_GT(other.change, 1);
  EXPECT_FALSE(other.met);
}

TEST(CohesiveZoneRule, WithoutAnyZoneIsNotMet) {
  const auto judgement = judge_cohesive_zone({none}, {none}, Field{none}, {1}, 0.2, 1);
  EXPECT_FALSE(judgement.met);
  EXPECT_TRUE(std::isinf(judgement.change));
}

TEST(GranularVelocityRule, IsInUnitsOfTheStandardError) {
  // |difference| 3, 4, 0 and 0, 0, 5; error 1 in each component.
  const auto judgement = judge_granular_velocity({3, 4, 0, 0, 0, 5}, {1, 1, 1, 1, 1, 1}, {2, 2}, 2);
  EXPECT_NEAR(judgement.figure, std::sqrt(50. / 6), 1e-12);
  EXPECT_NEAR(judgement.change, std::sqrt(50. / 6) / 2, 1e-12);
  EXPECT_FALSE(judgement.met);
  EXPECT_TRUE(judge_granular_velocity({0, 0, 0}, {0, 0, 0}, {1}, 2).met);
  EXPECT_FALSE(judge_granular_velocity({0, 0, 1}, {0, 0, 0}, {1}, 2).met);
}

TEST(Verdict, NeedsThreeEpisodesAndAllRulesInARow) {
  EXPECT_EQ(verdict({true, true}, 1, 0), Verdict::not_yet);
  EXPECT_EQ(verdict({false, false, true}, 1, 0), Verdict::converged);
  EXPECT_EQ(verdict({false, false, true}, 2, 0), Verdict::not_yet);
  EXPECT_EQ(verdict({false, false, true, false, true}, 2, 0), Verdict::not_yet);
  EXPECT_EQ(verdict({false, false, true, true}, 2, 0), Verdict::converged);
  EXPECT_EQ(verdict({true, true, true}, 4, 0), Verdict::not_yet);
}

TEST(Verdict, UnmeltedOreIsNoConvergence) {
  EXPECT_EQ(verdict({false, true, true}, 2, 0.051), Verdict::steady_ore_not_melted);
  EXPECT_EQ(verdict({false, true, true}, 2, 0.05), Verdict::converged);
}

}  // namespace
