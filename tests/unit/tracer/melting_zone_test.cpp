#include <gtest/gtest.h>

#include <cmath>

#include "stage_tracer/cohesive_zone.hpp"
#include "stage_tracer/ore_temperature.hpp"
#include "tests/support/box_mesh.hpp"

namespace cupola {
namespace {

using ::testing::Test;

class MeltingZoneTest : public Test {
 protected:
  MeltingZoneTest() {
    testing::BoxMesh box;
    box.cells = {6, 2, 40};
    box.upper = {3, 1, 10};
    box.lower = {-3, 0, 0};
    mesh_ = box.make();
    bed_.assign(mesh_.cells(), true);
    columns_ = mesh_columns(mesh_, bed_);
  }

  BedMesh mesh_;
  std::vector<bool> bed_;
  std::vector<Column> columns_;
  Softening softening_{1475, 1675};
};

TEST_F(MeltingZoneTest, ColumnsRunFromTheTopToTheBottom) {
  ASSERT_EQ(columns_.size(), 12U);
  double area = 0;
  for (const Column& column : columns_) {
    ASSERT_EQ(column.cells.size(), 40U);
    EXPECT_GT(mesh_.cell_centre[column.cells.front()][2], mesh_.cell_centre[column.cells.back()][2]);
    EXPECT_NEAR(column.x, mesh_.cell_centre[column.cells.back()][0], 1e-12);
    area += column.area;
  }
  EXPECT_NEAR(area, 6, 1e-12);
}

TEST_F(MeltingZoneTest, BedBelowAStockPlaneEndsThere) {
  for (std::size_t c = 0; c < mesh_.cells(); ++c) bed_[c] = mesh_.cell_centre[c][2] < 8;
  for (const Column& column : mesh_columns(mesh_, bed_)) EXPECT_EQ(column.cells.size(), 32U);
}

/// Ore at 2000 - 150 z - 40 |x| where that is below the melting temperature, none elsewhere.
TEST_F(MeltingZoneTest, ContinuationFindsTheIsothermOfALinearField) {
  std::vector<double> temperature(mesh_.cells());
  std::vector<double> weight(mesh_.cells());
  const std::vector<double> least(mesh_.cells(), 0.01);
  const auto field = [](const Vector3& r) { return 2000 - 150 * r[2] - 40 * std::abs(r[0]); };
  for (std::size_t c = 0; c < mesh_.cells(); ++c) {
    temperature[c] = field(mesh_.cell_centre[c]);
    weight[c] = temperature[c] < 1675 ? 1 : 0;
    if (weight[c] == 0) temperature[c] = 0;
  }
  const auto ore = continue_ore_temperature(mesh_, columns_, temperature, weight, least, softening_, 293);
  for (std::size_t c = 0; c < mesh_.cells(); ++c) {
    if (weight[c] > 0) {
      EXPECT_NEAR(ore[c], temperature[c], 1e-9);
    } else {
      EXPECT_GE(ore[c], 1675);
      EXPECT_LE(ore[c], 1875);
    }
  }
  for (const Column& column : columns_) {
    for (std::size_t i = 1; i < column.cells.size(); ++i) EXPECT_GE(ore[column.cells[i]], ore[column.cells[i - 1]]);
  }
  const Isotherm melted = find_isotherm(mesh_, columns_, ore, 1675);
  EXPECT_EQ(melted.columns_without, 0);
  double mean = 0;
  for (std::size_t k = 0; k < columns_.size(); ++k) {
    const double exact = (2000 - 40 * std::abs(columns_[k].x) - 1675) / 150;
    EXPECT_NEAR(melted.height[k], exact, 1e-9);
    mean += exact / static_cast<double>(columns_.size());
  }
  EXPECT_NEAR(melted.height_mean, mean, 1e-9);
  EXPECT_NEAR(melted.height_max, (2000 - 20 - 1675) / 150.0, 1e-9);
  const Isotherm softened = find_isotherm(mesh_, columns_, ore, 1475);
  for (std::size_t k = 0; k < columns_.size(); ++k) {
    EXPECT_NEAR(softened.height[k], (2000 - 40 * std::abs(columns_[k].x) - 1475) / 150, 1e-9);
  }
}

TEST_F(MeltingZoneTest, GapsBetweenLayersAreBridgedAndNoiseDoesNotShiftTheMean) {
  std::vector<double> temperature(mesh_.cells(), 0.0);
  std::vector<double> weight(mesh_.cells(), 0.0);
  for (const Column& column : columns_) {
    for (std::size_t i = 0; i < column.cells.size(); ++i) {
      if (i % 3 == 1) continue;  // a layer without ore
      temperature[column.cells[i]] = 400 + 20.0 * static_cast<double>(i) + (i % 2 == 0 ? 30 : -30);
      weight[column.cells[i]] = 1;
    }
  }
  const auto ore = continue_ore_temperature(mesh_, columns_, temperature, weight,
                                            std::vector<double>(mesh_.cells(), 0.5), softening_, 293);
  double before = 0;
  double after = 0;
  for (const std::int64_t cell : columns_[3].cells) {
    before += weight[cell] * temperature[cell];
    after += weight[cell] * ore[cell];
  }
  EXPECT_NEAR(after, before, 1e-9 * before);
  for (std::size_t i = 1; i < 40; ++i) EXPECT_GE(ore[columns_[3].cells[i]], ore[columns_[3].cells[i - 1]] - 1e-12);
}

TEST_F(MeltingZoneTest, OreThatNeverMeltsLeavesNoCrossingAboveItsEnd) {
  std::vector<double> temperature(mesh_.cells(), 900.0);
  std::vector<double> weight(mesh_.cells(), 1.0);
  const auto ore = continue_ore_temperature(mesh_, columns_, temperature, weight,
                                            std::vector<double>(mesh_.cells(), 0.5), softening_, 293);
  const Isotherm melted = find_isotherm(mesh_, columns_, ore, 1675);
  EXPECT_EQ(melted.columns_without, 12);
  EXPECT_TRUE(std::isnan(melted.height_mean));
  EXPECT_TRUE(std::isnan(melted.height.front()));
}

TEST_F(MeltingZoneTest, BedWithoutOreCountsAsMelted) {
  const std::vector<double> none(mesh_.cells(), 0.0);
  const auto ore =
      continue_ore_temperature(mesh_, columns_, none, none, std::vector<double>(mesh_.cells(), 0.5), softening_, 293);
  for (const double t : ore) EXPECT_DOUBLE_EQ(t, 1675);
}

TEST(Isotonic, PoolsViolatorsByWeight) {
  const auto fit = isotonic({1, 3, 2, 4}, {1, 1, 3, 1});
  EXPECT_DOUBLE_EQ(fit[0], 1);
  EXPECT_DOUBLE_EQ(fit[1], 2.25);
  EXPECT_DOUBLE_EQ(fit[2], 2.25);
  EXPECT_DOUBLE_EQ(fit[3], 4);
}

}  // namespace
}  // namespace cupola
