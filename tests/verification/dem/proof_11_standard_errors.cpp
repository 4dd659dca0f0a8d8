// Standard errors mean what they say: coverage over 20 seeds of fields whose mean is known.
#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "stage_dem/window_averages.hpp"

namespace cupola::test {
namespace {

TEST(StandardErrors, CoverTheTruthAsOftenAsTheySay) {
  // Velocities that forget themselves as the bed's do (over 0.2 s; NUMERICS: the fraction over 0.75 s), sampled every
  // block of 0.05 s over a window of 4 s in batches of 0.4 s, in 200 cells: a first-order autoregressive process.
  constexpr std::size_t cells = 200;
  constexpr double block = 0.05, window = 4, fraction = 0.56, speed = 0.2, scatter = 0.1;
  const double remembered = std::exp(-block / 0.2);
  double within_one = 0, within_two = 0, all = 0;
  for (unsigned seed = 1; seed <= 20; ++seed) {
    std::mt19937_64 random(seed);
    std::normal_distribution<double> normal(0, scatter);
    WindowAverages averages(cells, window / 10);
    std::vector<double> noise(3 * cells);
    for (auto& value : noise) value = normal(random);
    BedSample sample{std::vector<double>(cells, fraction), std::vector<double>(cells, fraction),
                     std::vector<double>(3 * cells)};
    for (int i = 0; i < std::lround(window / block); ++i) {
      for (std::size_t k = 0; k < noise.size(); ++k) {
        noise[k] = remembered * noise[k] + std::sqrt(1 - remembered * remembered) * normal(random);
        sample.flux[k] = fraction * (speed + noise[k]);
      }
      averages.add(sample, block);
    }
    const auto fields = averages.fields();
    for (std::size_t k = 0; k < noise.size(); ++k) {
      const double off = std::abs(fields.velocity[k] - speed) / fields.velocity_error[k];
      within_one += off < 1 ? 1 : 0;
      within_two += off < 2 ? 1 : 0;
      ++all;
    }
  }
  // Of ten batches Student's t has 66 % and 92 % within one and two standard errors; near 68 % and 95 %.
  EXPECT_NEAR(within_one / all, 0.68, 0.05);
  EXPECT_NEAR(within_two / all, 0.95, 0.05);
}

}  // namespace
}  // namespace cupola::test
