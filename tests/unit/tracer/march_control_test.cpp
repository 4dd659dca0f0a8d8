#include <gtest/gtest.h>

#include <cmath>

#include "stage_tracer/random.hpp"
#include "stage_tracer/steady_watch.hpp"
#include "stage_tracer/step_error.hpp"
#include "tests/support/furnaces.hpp"

/// When a march is there, and what its step costs in accuracy.
namespace cupola {
namespace {

constexpr std::size_t cells = 200;

/// A field that approaches its steady state with a slow mode, a fast one, and the noise of the layers.
struct Approach {
  double slow = 0.9;  ///< what is left of the slow mode after a window
  double noise = 0;   ///< K

  [[nodiscard]] double at(std::size_t cell, std::size_t window) const {
    const double x = static_cast<double>(cell) / cells;
    const double n = static_cast<double>(window);
    const double random = 2 * random_uniform(3, RandomUse::seeding, cell + 1000 * window)[0] - 1;
    return 1000 + 500 * x - 300 * std::sin(3 * x) * std::pow(slow, n) + 200 * std::cos(9 * x) * std::pow(0.3, n) +
           noise * random;
  }
  [[nodiscard]] double true_change(std::size_t window) const {
    double square = 0;
    double norm = 0;
    for (std::size_t c = 0; c < cells; ++c) {
      const double x = static_cast<double>(c) / cells;
      square += std::pow(300 * std::sin(3 * x) * std::pow(slow, static_cast<double>(window)), 2);
      norm += std::pow(1000 + 500 * x - 293, 2);
    }
    return std::sqrt(square / norm);
  }
};

void add(SteadyWatch& watch, const Approach& approach, std::size_t window) {
  std::vector<double> temperature(cells);
  for (std::size_t c = 0; c < cells; ++c) temperature[c] = approach.at(c, window);
  watch.add(std::vector<double>(cells, 2e6), temperature);
}

TEST(SteadyWatch, SaysNothingBeforeEightWindows) {
  SteadyWatch watch;
  for (std::size_t n = 0; n < SteadyWatch::least_windows; ++n) {
    EXPECT_FALSE(watch.remaining().has_value());
    add(watch, {}, n);
  }
  EXPECT_TRUE(watch.remaining().has_value());
}

TEST(SteadyWatch, NotFarBelowTheTrueRemainingChangeNorFarAbove) {
  for (const double slow : {0.8, 0.9, 0.97}) {
    for (const double noise : {0.0, 10.0}) {
      const Approach approach{slow, noise};
      SteadyWatch watch;
      int judged = 0;
      for (std::size_t n = 0; n < 150; ++n) {
        add(watch, approach, n);
        const auto remaining = watch.remaining();
        if (!remaining) continue;
        ++judged;
        const double truth = approach.true_change(n);
        if (truth < 1e-10) continue;  // round-off
        EXPECT_GT(remaining->change, 0.7 * truth) << slow << ' ' << noise << ' ' << n;
        if (noise == 0 && truth > 1e-4) {
          EXPECT_LT(remaining->change, 30 * truth + 1e-3) << slow << ' ' << n;
        }
      }
      EXPECT_GT(judged, 40) << slow << ' ' << noise;
    }
  }
}

TEST(SteadyWatch, ASteadyDriftIsNeverSteady) {
  SteadyWatch watch;
  for (std::size_t n = 0; n < 60; ++n) {
    std::vector<double> temperature(cells, 1000 + 0.2 * static_cast<double>(n));
    watch.add(std::vector<double>(cells, 1.0), temperature);
    EXPECT_EQ(watch.below(0.05), 0) << n;  // the changes do not shrink, however small they are
  }
}

TEST(SteadyWatch, LeavesOutCellsWithoutCapacityAndSurvivesACheckpoint) {
  SteadyWatch watch;
  SteadyWatch spoilt;
  for (std::size_t n = 0; n < 77; ++n) {  // windows have been joined by then
    std::vector<double> capacity(cells, 1.0);
    std::vector<double> temperature(cells);
    for (std::size_t c = 0; c < cells; ++c) temperature[c] = Approach{}.at(c, n);
    capacity[5] = 0;
    watch.add(capacity, temperature);
    temperature[5] = 1e4 * static_cast<double>(n);
    spoilt.add(capacity, temperature);
    if (n % 11 == 0) {
      SteadyWatch other;
      other.restore(spoilt.row());
      spoilt = other;
    }
  }
  ASSERT_TRUE(watch.remaining().has_value());
  ASSERT_TRUE(spoilt.remaining().has_value());
  EXPECT_EQ(watch.remaining()->change, spoilt.remaining()->change);
  EXPECT_EQ(watch.below(0.01), spoilt.below(0.01));
  EXPECT_EQ(watch.windows(), 77U);
}

SolidsState three(double a, double b, double c) {
  SolidsState state;
  state.capacity = {1, 1, 0};
  state.temperature = {a, b, c};
  return state;
}

TEST(StepError, ComparesCellsByTheirHeat) {
  EXPECT_NEAR(temperature_difference(three(1003, 893, 493), three(993, 893, 293)),
              std::sqrt(100.0 / (700 * 700 + 600 * 600)), 1e-12);
  Campaign campaign = furnaces::shaft();
  for (Species& species : campaign.species) species.heat_capacity = 800;
  const SolidsState state({{{1e-3, 0}, {2e-3, 0}}, {{900, 0}, {600, 0}}}, campaign);
  const double coke = 1e-3 * campaign.species[0].density;
  const double ore = 2e-3 * campaign.species[1].density;
  EXPECT_NEAR(state.capacity[0], 800 * (coke + ore), 1e-9);
  EXPECT_NEAR(state.temperature[0], (900 * coke + 600 * ore) / (coke + ore), 1e-9);
  EXPECT_EQ(state.capacity[1], 0);
}

TEST(StepError, GrowsAsItWasSeenToGrow) {
  // Differences after 20 s and 80 s, of steps of 10 s.
  const StepError adds_up{10, 0.001, 0.004, 80, 1e9};
  EXPECT_DOUBLE_EQ(adds_up.growth(), 1);
  EXPECT_NEAR(adds_up.after(800, 10), 0.04, 1e-12);
  EXPECT_NEAR(adds_up.after(800, 5), 0.02, 1e-12);
  const StepError random{10, 0.001, 0.002, 80, 320};
  EXPECT_DOUBLE_EQ(random.growth(), 0.5);
  EXPECT_NEAR(random.after(1e6, 10), 0.004, 1e-12);  // what is older than the memory is forgotten
  EXPECT_NEAR(random.after(10, 10), 0.002, 1e-12);   // never below what was seen
  EXPECT_EQ((StepError{10, 0.001, 0.0005, 80, 320}).growth(), 0.5);
  EXPECT_FALSE(StepError{}.known());
  EXPECT_EQ(StepError{}.after(100, 10), 0);
  EXPECT_EQ(StepError::from_row(random.row()).row(), random.row());
}

TEST(StepTrial, SurvivesACheckpoint) {
  const StepTrial trial{4, 3, three(1, 2, 3), three(4, 5, 6)};
  const StepTrial again = StepTrial::from_row(trial.row());
  EXPECT_EQ(again.row(), trial.row());
  EXPECT_EQ(again.pairs, 3);
  EXPECT_EQ(again.late.temperature, trial.late.temperature);
}

}  // namespace
}  // namespace cupola
