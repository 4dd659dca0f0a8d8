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

Tracers three(double a, double b, double c) {
  Tracers tracers;
  for (std::int64_t id = 0; id < 3; ++id) tracers.add(3 - id, 0, {}, 1e-3, 1);
  tracers.temperature = {a, b, c};
  return tracers;
}

TEST(StepError, ComparesTracersByIdAndScalesWithTheStep) {
  Campaign campaign = furnaces::shaft();
  campaign.species[0].heat_capacity = 800;
  const TracerTemperatures one(three(1003, 893, 493));
  Tracers other = three(993, 893, 493);
  other.id[2] = 7;  // a tracer that the first does not have counts in neither
  const double difference = temperature_difference(one, other, campaign, [](std::vector<double>&) {});
  EXPECT_NEAR(difference, std::sqrt(100.0 / (700 * 700 + 600 * 600)), 1e-12);

  const StepError error{0.002, 10};
  EXPECT_DOUBLE_EQ(error.after(100, 1e9), 0.01);
  EXPECT_DOUBLE_EQ(error.after(100, 50), 0.005);
}

}  // namespace
}  // namespace cupola
