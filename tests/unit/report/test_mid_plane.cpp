#include <gtest/gtest.h>

#include <cmath>

#include "orchestrator/report/mid_plane.hpp"

namespace cupola {
namespace {

/// A slot of half width w(z) = 1 + z/4 from z = 0 to 2, depth 0.6, with cells across, deep and up.
struct Slot {
  std::vector<double> points;
  std::vector<std::int64_t> cell_points;

  Slot(int across, int deep, int up) {
    const auto point = [&](int i, int j, int k) { return std::int64_t{(k * (deep + 1) + j) * (across + 1) + i}; };
    for (int k = 0; k <= up; ++k) {
      const double z = 2.0 * k / up;
      for (int j = 0; j <= deep; ++j) {
        for (int i = 0; i <= across; ++i) {
          points.insert(points.end(), {(1 + z / 4) * (2.0 * i / across - 1), 0.6 * (double(j) / deep - 0.5), z});
        }
      }
    }
    for (int k = 0; k < up; ++k) {
      for (int j = 0; j < deep; ++j) {
        for (int i = 0; i < across; ++i) {
          for (const int level : {k, k + 1}) {
            cell_points.insert(cell_points.end(), {point(i, j, level), point(i + 1, j, level),
                                                   point(i + 1, j + 1, level), point(i, j + 1, level)});
          }
        }
      }
    }
  }
};

double area(const CutCell& cut) {
  double twice = 0;
  for (std::size_t i = 0; i < cut.corners.size(); ++i) {
    const auto& [x0, z0] = cut.corners[i];
    const auto& [x1, z1] = cut.corners[(i + 1) % cut.corners.size()];
    twice += x0 * z1 - x1 * z0;
  }
  return twice / 2;
}

TEST(MidPlane, CoversTheProfileExactlyOnce) {
  for (const int deep : {1, 2, 3}) {
    const Slot slot(7, deep, 5);
    const MidPlane plane = cut_mid_plane(slot.points, slot.cell_points);
    EXPECT_EQ(plane.cells.size(), 35U) << "one layer of cells, whether or not faces lie in the middle";
    double sum = 0;
    for (const CutCell& cut : plane.cells) {
      EXPECT_EQ(cut.corners.size(), 4U);
      EXPECT_GT(area(cut), 0) << "corners run anticlockwise";
      sum += area(cut);
    }
    EXPECT_NEAR(sum, 5.0, 1e-12) << "integral of 2 + z/2 over 0 … 2";
    EXPECT_NEAR(plane.y, 0, 1e-3 * 0.6 + 1e-12);
  }
}

TEST(MidPlane, NamesTheCellsItCuts) {
  const Slot slot(2, 3, 1);
  const MidPlane plane = cut_mid_plane(slot.points, slot.cell_points);
  ASSERT_EQ(plane.cells.size(), 2U);
  EXPECT_EQ(plane.cells[0].cell, 2U) << "the middle one of three layers";
  EXPECT_EQ(plane.cells[1].cell, 3U);
  EXPECT_LT(plane.cells[0].centre[0], 0);
  EXPECT_DOUBLE_EQ(plane.cells[0].centre[1], 1);
}

}  // namespace
}  // namespace cupola
