#include "stage_dem/stationarity.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

namespace cupola {
namespace {

/// Noise that forgets itself over four samples, on a mean that relaxes.
std::vector<double> relaxing(unsigned seed, std::size_t samples, double start, double end, double time) {
  std::mt19937_64 random(seed);
  std::normal_distribution<double> normal;
  std::vector<double> series;
  double noise = normal(random);
  const double remembered = std::exp(-1.0 / 4);
  for (std::size_t i = 0; i < samples; ++i) {
    noise = remembered * noise + std::sqrt(1 - remembered * remembered) * normal(random);
    series.push_back(end + (start - end) * std::exp(-static_cast<double>(i) / time) + 0.1 * noise);
  }
  return series;
}

TEST(Stationarity, ASeriesAtRestIsSeldomTakenForADrift) {
  int drifting = 0;
  for (unsigned seed = 0; seed < 200; ++seed)
    drifting += std::abs(drift(relaxing(seed, 200, 1, 1, 50))) > stationary_up_to ? 1 : 0;
  EXPECT_LT(drifting, 40);  // 8 degrees of freedom, batches of five times the memory: about one in nine
}

TEST(Stationarity, ARelaxationIsSeenWhileItLasts) {
  for (unsigned seed = 0; seed < 50; ++seed) {
    EXPECT_LT(drift(relaxing(seed, 100, 2, 1, 50)), -stationary_up_to) << seed;
    EXPECT_GT(drift(relaxing(seed, 100, 0, 1, 50)), stationary_up_to) << seed;
  }
}

TEST(Stationarity, NeedsSomeSamples) {
  EXPECT_TRUE(std::isinf(drift({})));
  EXPECT_TRUE(std::isinf(drift(std::vector<double>(least_samples - 1, 1))));
  EXPECT_EQ(drift(std::vector<double>(least_samples, 1)), 0);
}

}  // namespace
}  // namespace cupola
