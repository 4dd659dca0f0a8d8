#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "physics/closures/drag.hpp"
#include "physics/closures/drag_di_felice.hpp"
#include "physics/closures/drag_emms.hpp"
#include "physics/closures/drag_ergun.hpp"
#include "physics/closures/drag_filtered.hpp"
#include "physics/closures/drag_gidaspow.hpp"
#include "physics/closures/drag_koch_hill.hpp"

namespace cupola {
namespace {

/// In the units in which d = mu = rho = 1 the speed is the Reynolds number and the resistance of a dilute bed in
/// creeping flow is 18 a (Stokes).
double over_stokes(DragLaw law, double void_fraction, double reynolds) {
  return drag_resistance(law, void_fraction, 1, 1, 1, reynolds) / (18 * (1 - void_fraction));
}

TEST(DragLaws, DiluteCreepingGrainsFeelStokesDrag) {
  constexpr double e = 1 - 1e-9;
  EXPECT_NEAR(over_stokes(DragLaw::wen_yu, e, 1e-9), 1, 1e-5);
  EXPECT_NEAR(over_stokes(DragLaw::beetstra, e, 1e-9), 1, 1e-4);
  EXPECT_NEAR(over_stokes(DragLaw::koch_hill, e, 1e-9), 1, 1e-4);
  EXPECT_NEAR(over_stokes(DragLaw::di_felice, e, 1e-12), 4.8 * 4.8 / 24, 1e-5);  // Dallavalle's own limit: 0.96
}

TEST(DragLaws, PackedCreepingBedsFollowCarman) {
  // Koch and Hill: 180 mu a^2/(e^3 d^2); Ergun has 150 there, Beetstra lies between (e^2 (1 + 1.5 sqrt a) on top).
  const double a = 0.56, e = 0.44;
  EXPECT_NEAR(koch_hill_resistance(e, 1, 1, 1, 0) / (180 * a * a / std::pow(e, 3)), 1, 1e-12);
  EXPECT_NEAR(drag_resistance(DragLaw::beetstra, e, 1, 1, 1, 0) / (180 * a * a / std::pow(e, 3)), 1, 0.02);
  EXPECT_NEAR(ergun_resistance(e, 1, 1, 1, 0) / (150 * a * a / std::pow(e, 3)), 1, 1e-12);
}

TEST(DragLaws, AgreeWithinTheScatterOfTheFits) {
  // All laws for packed beds within 45 % of Ergun where all of them hold; the dispersed ones within 25 % of Wen and Yu.
  for (const double reynolds : {1.0, 10.0, 100.0}) {
    for (const auto law : {DragLaw::beetstra, DragLaw::koch_hill, DragLaw::di_felice}) {
      const double ergun = drag_resistance(DragLaw::ergun, 0.42, 1, 1, 1, reynolds);
      EXPECT_NEAR(drag_resistance(law, 0.42, 1, 1, 1, reynolds) / ergun, 1, 0.45) << drag_law_name(law) << reynolds;
    }
    const double wen_yu = drag_resistance(DragLaw::wen_yu, 0.98, 1, 1, 1, reynolds);
    EXPECT_NEAR(drag_resistance(DragLaw::di_felice, 0.98, 1, 1, 1, reynolds) / wen_yu, 1, 0.25) << reynolds;
  }
}

TEST(DragLaws, GrowWithTheSpeedAndAreFiniteAtRest) {
  for (const auto law : {DragLaw::ergun, DragLaw::wen_yu, DragLaw::gidaspow, DragLaw::di_felice, DragLaw::koch_hill,
                         DragLaw::beetstra, DragLaw::emms}) {
    for (const double e : {0.1, 0.35, 0.45, 0.7, 0.85, 0.95, 0.995, 0.99999}) {
      double before = 0;
      for (double speed = 0; speed < 10; speed += 0.05) {
        const double pressure_gradient = speed * drag_resistance(law, e, 1e-3, 2e-5, 1, speed);
        ASSERT_TRUE(std::isfinite(pressure_gradient)) << drag_law_name(law) << " e " << e << " U " << speed;
        EXPECT_TRUE(speed == 0 || pressure_gradient > before) << drag_law_name(law) << " e " << e << " U " << speed;
        before = pressure_gradient;
      }
    }
  }
}

TEST(DiFelice, ResistanceAsPublished) {
  // Evaluated independently from the published formula at (void fraction, Re).
  EXPECT_NEAR(di_felice_resistance(0.45, 1, 1, 1, 1), 438.2725582495677, 1e-9);
  EXPECT_NEAR(di_felice_resistance(0.6, 1, 1, 1, 30), 161.6675947476956, 1e-9);
  EXPECT_NEAR(di_felice_resistance(0.9, 1, 1, 1, 1000), 73.56055726841699, 1e-10);
}

TEST(DiFelice, ExponentIsThatOfWenAndYuAtBothEndsAndLeastBetween) {
  // e^-(chi + 1): 4.7 for creeping and for fast flow (Wen and Yu: 4.65), 0.65 less at Re = 10^1.5.
  const auto exponent = [](double reynolds) {
    const double loose = over_stokes(DragLaw::di_felice, 1 - 1e-9, reynolds);
    return -std::log(over_stokes(DragLaw::di_felice, 0.5, reynolds) / loose) / std::log(0.5);
  };
  EXPECT_NEAR(exponent(1e-6), 4.7, 1e-6);
  EXPECT_NEAR(exponent(1e9), 4.7, 1e-6);
  EXPECT_NEAR(exponent(std::pow(10, 1.5)), 4.05, 1e-6);
}

TEST(KochHill, DragOverStokesAsPublished) {
  EXPECT_NEAR(over_stokes(DragLaw::koch_hill, 0.9, 0), 2.8232292278019337, 1e-12);
  EXPECT_NEAR(over_stokes(DragLaw::koch_hill, 0.7, 50), 16.16072340116599, 1e-11);
  EXPECT_NEAR(over_stokes(DragLaw::koch_hill, 0.5, 100), 85.785, 1e-10);
  // The two formulas of the creeping part meet at a = 0.4.
  EXPECT_NEAR(over_stokes(DragLaw::koch_hill, 0.6 + 1e-9, 0) / over_stokes(DragLaw::koch_hill, 0.6, 0), 1, 0.02);
}

struct Index {
  double void_fraction, reynolds, index;
};

TEST(Emms, IndexAtTheEndsAndMiddleOfEveryRange) {
  // The table of fits evaluated independently, first and last value and middle of every range.
  const std::vector<Index> table{{0.4000, 1, 0.2598606948},
                                 {0.4325, 1, 0.4156757265},
                                 {0.4649, 1, 0.5833857353},
                                 {0.4649, 5, 0.5833857353},
                                 {0.4650, 1, 0.6072833590},
                                 {0.5375, 1, 0.0990973103},
                                 {0.6099, 1, 0.0196702337},
                                 {0.4650, 5, 0.6101800092},
                                 {0.5375, 5, 0.1492481497},
                                 {0.6099, 5, 0.0363786251},
                                 {0.6100, 1, 0.0168941566},
                                 {0.8000, 1, 0.0223879313},
                                 {0.9000, 1, 0.0347795453},
                                 {0.9897, 1, 0.2566212437},
                                 {0.6100, 5, 0.0313927524},
                                 {0.8000, 5, 0.0378471926},
                                 {0.9000, 5, 0.0558882919},
                                 {0.9897, 5, 0.3955832892},
                                 {0.9898, 1, 0.2999557753},
                                 {0.9948, 1, 0.7650824767},
                                 {0.9996, 1, 0.8459097571},
                                 {0.9898, 5, 0.4187336527},
                                 {0.9948, 5, 0.8673466016},
                                 {0.9996, 5, 0.9434558121},
                                 {0.9997, 1, 1},
                                 {0.99985, 5, 1},
                                 {1, 1, 1},
                                 {0.3999, 1, 1}};
  for (const auto& [e, reynolds, index] : table) {
    EXPECT_NEAR(emms_heterogeneity_index(e, reynolds), index, 1e-9) << e << " " << reynolds;
  }
}

TEST(Emms, FitsOfNeighbouringRangesMeet) {
  // No more than the scatter of the fits where the ranges meet: with the signs of the table as printed the index would
  // be negative at 0.465 and jump fivefold at 0.61.
  for (const double border : {0.465, 0.61, 0.9898, 0.9997}) {
    const double below = emms_heterogeneity_index(border - 1e-9, 1), above = emms_heterogeneity_index(border, 1);
    EXPECT_NEAR(above / below, 1, 0.3) << border;
  }
}

TEST(Emms, LowersTheDragInTheDiluteBedALittleAndInTheDenseBedALot) {
  // Grains of seed 003 at a slip of a few cm/s.
  const auto ratio = [](double e) {
    return drag_resistance(DragLaw::emms, e, 36.24e-6, 1.85e-5, 1.18, 0.05) /
           drag_resistance(DragLaw::gidaspow, e, 36.24e-6, 1.85e-5, 1.18, 0.05);
  };
  EXPECT_LT(ratio(0.7), 0.05);
  EXPECT_GT(ratio(0.999), 0.3);
  EXPECT_DOUBLE_EQ(ratio(0.9999), 1);
  for (double e = 0.4; e < 1; e += 1e-4) {
    ASSERT_GT(ratio(e), 0) << e;
    ASSERT_LE(ratio(e), 1) << e;
  }
}

TEST(FilteredDrag, ParcelCorrectionConvergesToTheGrain) {
  EXPECT_DOUBLE_EQ(parcel_drag_correction(0.05, 1), 1);
  EXPECT_DOUBLE_EQ(parcel_drag_correction(0, 8), 1);
  EXPECT_DOUBLE_EQ(parcel_drag_correction(0.05, 4), std::exp(-0.15));
}

TEST(FilteredDrag, GridCorrectionHasItsLimits) {
  // 75 um grains of 1500 kg/m3 in air of 1.8e-5 Pa s settle at 0.2555 m/s (Stokes); a cell of 1 cm has F = 1.503.
  const double size = filter_size(0.01, 75e-6, 1500, 1.8e-5);
  EXPECT_NEAR(size, 9.81 * 0.01 / std::pow(9.81 * 75e-6 * 75e-6 * 1500 / (18 * 1.8e-5), 2), 1e-12);
  EXPECT_NEAR(size, 1.503, 1e-3);
  EXPECT_DOUBLE_EQ(grid_drag_correction(0, 0.2), 1);     // a fine mesh resolves the clusters
  EXPECT_DOUBLE_EQ(grid_drag_correction(size, 0), 1);    // no grains
  EXPECT_DOUBLE_EQ(grid_drag_correction(size, 0.6), 1);  // a packed bed has no clusters
  EXPECT_NEAR(grid_drag_correction(1e9, 0.3), 1 - 0.7690012117987504, 1e-9);
  EXPECT_NEAR(filter_solids_function(0.01), 0.6198906981035112, 1e-12);
  EXPECT_NEAR(filter_solids_function(0.1), 0.7911534573267691, 1e-12);
  EXPECT_NEAR(filter_solids_function(0.5), 0.16875, 1e-12);
  // The pieces of h meet.
  for (const double border : {0.0012, 0.014, 0.18, 0.25, 0.455, 0.59}) {
    EXPECT_NEAR(filter_solids_function(border - 1e-9), filter_solids_function(border + 1e-9), 0.01) << border;
  }
  // Grains of millimetres in cells of 0.2 m: nothing to correct.
  EXPECT_NEAR(grid_drag_correction(filter_size(0.2, 0.015, 3000, 2e-5), 0.3), 1, 1e-9);
}

}  // namespace
}  // namespace cupola
