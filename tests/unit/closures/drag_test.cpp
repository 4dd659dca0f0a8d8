#include "physics/closures/drag.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "physics/closures/drag_beetstra.hpp"
#include "physics/closures/drag_ergun.hpp"
#include "physics/closures/drag_gidaspow.hpp"

namespace cupola {
namespace {

// The Ergun bed of the reference cases: 1 mm grains, void fraction 0.451335, 15.6 mm long.
constexpr double bed_void = 0.451335, bed_length = 15.6e-3, grain = 1e-3, gas_rho = 10, gas_mu = 1.5e-4 * gas_rho;

double ergun_bed_drop(double speed) {
  return bed_length * speed * drag_resistance(DragLaw::ergun, bed_void, grain, gas_mu, gas_rho, speed);
}

TEST(Ergun, PressureDropOfTheReferenceBed) {
  EXPECT_NEAR(ergun_bed_drop(0.002), 22.992, 5e-4);
  EXPECT_NEAR(ergun_bed_drop(0.010), 115.09, 5e-3);
  EXPECT_NEAR(ergun_bed_drop(0.020), 230.51, 5e-3);
}

TEST(Ergun, CarriesTheBuoyantWeightAtMinimumFluidisation) {
  const double weight = (1 - bed_void) * (2000 - gas_rho) * 9.81 * bed_length;
  EXPECT_NEAR(weight, 167.09, 5e-3);
  EXPECT_NEAR(ergun_bed_drop(0.014509), weight, 0.01);
}

TEST(WenYu, EqualsStokesForADistantSlowGrain) {
  // One grain of 0.1 mm in 1e-9 of solids at Re 1e-8: resistance = number density x 3 pi mu d.
  const double solids = 1e-9, d = 1e-4, mu = 1.8e-5;
  const double number_density = solids / (M_PI / 6 * d * d * d);
  EXPECT_NEAR(wen_yu_resistance(1 - solids, d, mu, 1.2, 1e-8 * mu / 1.2 / d) / (number_density * 3 * M_PI * mu * d), 1,
              1e-5);
}

TEST(WenYu, ExchangeCoefficientAsPublished) {
  // Seed 004, eq. 5 and 6, written with the slip velocity.
  const double e = 0.9, d = 1.5e-3, mu = 1.8e-5, rho = 1.2, slip = 2.0;
  const double reynolds = e * rho * slip * d / mu;
  const double drag = 24 / reynolds * (1 + 0.15 * std::pow(reynolds, 0.687));
  const double published = 0.75 * drag * (1 - e) * e * rho * slip / d * std::pow(e, -2.65);
  EXPECT_NEAR(drag_exchange(DragLaw::gidaspow, e, d, mu, rho, e * slip) / published, 1, 1e-12);
}

TEST(WenYu, ConstantDragCoefficientAboveAThousand) {
  const double e = 0.85, d = 0.044, mu = 2e-5, rho = 1, speed = 10;
  EXPECT_NEAR(wen_yu_resistance(e, d, mu, rho, speed) / (0.75 * 0.44 * rho * speed * (1 - e) / d * std::pow(e, -4.65)),
              1, 1e-12);
}

TEST(Gidaspow, IsErgunBelowAndWenYuAboveFourFifths) {
  const double d = 4e-3, mu = 1.8e-5, rho = 1.2, speed = 0.5;
  EXPECT_EQ(gidaspow_resistance(0.42, d, mu, rho, speed), ergun_resistance(0.42, d, mu, rho, speed));
  EXPECT_EQ(gidaspow_resistance(0.80, d, mu, rho, speed), ergun_resistance(0.80, d, mu, rho, speed));
  EXPECT_EQ(gidaspow_resistance(0.81, d, mu, rho, speed), wen_yu_resistance(0.81, d, mu, rho, speed));
}

TEST(Gidaspow, ExchangeCoefficientAsPublishedInPackedBeds) {
  // Seed 004, eq. 8.
  const double e = 0.45, d = 4e-3, mu = 1.8e-5, rho = 1.2, slip = 1.3;
  const double published = 150 * (1 - e) * (1 - e) * mu / (e * d * d) + 1.75 * rho * (1 - e) * slip / d;
  EXPECT_NEAR(drag_exchange(DragLaw::gidaspow, e, d, mu, rho, e * slip) / published, 1, 1e-12);
}

TEST(Beetstra, CreepingLimitOfADensePacking) {
  // Re -> 0: F = 10 a/e^2 + e^2 (1 + 1.5 sqrt a); a = 0.56 gives 5.6/0.1936 for the first term.
  const double a = 0.56, e = 0.44, d = 0.015, mu = 2e-5;
  const double drag = 28.925619834710744 + 0.1936 * (1 + 1.5 * 0.74833147735478828);
  EXPECT_NEAR(beetstra_resistance(e, d, mu, 1, 0) / (18 * mu * a * drag / (e * d * d)), 1, 1e-12);
}

TEST(Beetstra, DragOverStokesAtFiniteReynoldsNumber) {
  // F written out independently from the published formula at (void fraction, Re).
  const auto over_stokes = [](double e, double reynolds) {
    return beetstra_resistance(e, 1, 1, 1, reynolds) * e / (18 * (1 - e));
  };
  EXPECT_NEAR(over_stokes(0.4, 100), 89.78941537235846, 1e-10);
  EXPECT_NEAR(over_stokes(0.5, 1000), 263.64885409976625, 1e-10);
  EXPECT_NEAR(over_stokes(0.9, 10), 3.2180694125695455, 1e-12);
}

TEST(Beetstra, AgreesWithErgunWhereBothHold) {
  // Both were fitted to packed beds: within a third at a void fraction of 0.4 to 0.46 and Re 1 to 1000.
  for (const double e : {0.40, 0.44, 0.46}) {
    for (const double reynolds : {1.0, 10.0, 100.0, 1000.0}) {
      EXPECT_NEAR(beetstra_resistance(e, 1, 1, 1, reynolds) / ergun_resistance(e, 1, 1, 1, reynolds), 1, 0.34)
          << e << " " << reynolds;
    }
  }
}

TEST(Beetstra, PolydispersityIsOneForOneSizeAndTheSumOverGrainsForTwo) {
  EXPECT_DOUBLE_EQ(beetstra_polydispersity(1), 1);
  // Equal volumes of 15 and 44 mm: sum over the grains of number x 3 pi mu d_i y-factor, over that of equal grains of
  // d_S.
  const double d1 = 0.015, d2 = 0.044, share = 0.5;
  const double sauter = 1 / (share / d1 + share / d2);
  double sum = 0;
  for (const double d : {d1, d2}) sum += share / (d * d * d) * d * beetstra_grain_polydispersity(d / sauter);
  const double equal = 1 / (sauter * sauter) * beetstra_grain_polydispersity(1);
  EXPECT_NEAR(beetstra_polydispersity(share * (d1 + d2) / sauter), sum / equal, 1e-14);
  EXPECT_NEAR(drag_resistance(DragLaw::beetstra, 0.44, sauter, 2e-5, 1, 1, 1.02) /
                  drag_resistance(DragLaw::beetstra, 0.44, sauter, 2e-5, 1, 1),
              1.02, 1e-14);
}

TEST(Drag, GrowsWithSpeedAndSolidsAndIsContinuousInSpeed) {
  for (const auto law : {DragLaw::ergun, DragLaw::gidaspow, DragLaw::beetstra}) {
    for (double e = 0.30; e < 0.79; e += 0.01) {
      double before = 0;
      for (double speed = 0; speed < 12; speed += 0.01) {
        const double r = drag_resistance(law, e, 0.015, 2e-5, 0.4, speed);
        EXPECT_GT(r, before) << drag_law_name(law) << " e " << e << " U " << speed;
        if (speed > 0.5) {
          EXPECT_LT(r, before * 1.05);
        }
        before = r;
      }
      EXPECT_GT(drag_resistance(law, e, 0.015, 2e-5, 0.4, 3), drag_resistance(law, e + 0.005, 0.015, 2e-5, 0.4, 3));
    }
  }
}

}  // namespace
}  // namespace cupola
