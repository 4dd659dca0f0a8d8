#include "stage_tracer/predictor/stay.hpp"

#include <gtest/gtest.h>

namespace cupola {
namespace {

/// Simpson's rule over the stay, of a function of time.
template <class Function>
double integral(double time, Function function) {
  constexpr int pieces = 2000;
  const double h = time / pieces;
  double sum = function(0.0) + function(time);
  for (int i = 1; i < pieces; ++i) sum += (i % 2 == 1 ? 4 : 2) * function(i * h);
  return sum * h / 3;
}

TEST(StayOfSolids, ClosedFormsAreTheIntegrals) {
  for (const double rate : {0.0, 1e-9, 1e-4, 0.02}) {
    for (const double removal : {0.0, 1e-8, 0.005, 0.1}) {
      const StayOfSolids stay(400, rate, 1500, 0.3, removal);
      const double time = 120;
      EXPECT_NEAR(stay.volume_time(time), integral(time, [&](double t) { return std::exp(-removal * t); }),
                  1e-9 * time);
      const double excess =
          integral(time, [&](double t) { return std::exp(-removal * t) * (stay.temperature(t) - 400); });
      EXPECT_NEAR(stay.excess_time(time), excess, 1e-6 * excess) << rate << " " << removal;
    }
  }
}

TEST(StayOfSolids, TheTimeOfATemperatureIsItsInverse) {
  for (const double rate : {0.0, 1e-6, 0.01}) {
    const StayOfSolids stay(400, rate, 1500, 2.0, 0);
    EXPECT_NEAR(stay.temperature(stay.time_of(550)), 550, 1e-9);
  }
  EXPECT_EQ(StayOfSolids(400, 0.1, 300, 0, 0).time_of(500), HUGE_VAL) << "it cools";
  EXPECT_EQ(StayOfSolids(400, 0.1, 450, 0, 0).time_of(500), HUGE_VAL) << "it never gets there";
  EXPECT_EQ(StayOfSolids(400, 0.1, 450, 0, 0).time_of(350), 0) << "it is hotter already";
}

TEST(StayOfSolids, AStayWithoutEndUsesEverythingUp) {
  const StayOfSolids stay(400, 0.01, 1500, 0, 0.2);
  EXPECT_NEAR(stay.volume_time(1e12), 1 / 0.2, 1e-9);
  EXPECT_NEAR(stay.temperature(1e12), 1500, 1e-9);
}

}  // namespace
}  // namespace cupola
