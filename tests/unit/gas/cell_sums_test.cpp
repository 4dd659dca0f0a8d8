#include "physics/projection/cell_sums.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "tests/support/box_mesh.hpp"

namespace cupola {
namespace {

double total(const std::vector<CellShare>& shares) {
  double sum = 0;
  for (const auto& share : shares) sum += share.share;
  return sum;
}

TEST(DivideParcel, VolumeIsConservedForAnyRatioOfParcelToCell) {
  const BedMesh mesh = testing::BoxMesh{{10, 6, 10}, {0, -0.3, 0}, {1, 0.3, 1}, true}.make();
  const CellLocator locator(mesh);
  std::vector<CellShare> shares;
  for (const double ratio : {0.2, 0.5, 1.0, 2.0, 5.0}) {
    std::int64_t guess = -1;
    for (int i = 0; i < 200; ++i) {
      const Vector3 centre{0.5 + 0.5 * std::sin(i), 0.3 * std::sin(1.3 * i), 0.5 + 0.499 * std::cos(0.7 * i)};
      const auto count = divide_parcel(locator, centre, ratio * 0.05, guess, shares);
      ASSERT_GT(count, 0U);
      ASSERT_EQ(count, shares.size());
      EXPECT_NEAR(total(shares), 1, 1e-14);
    }
  }
}

TEST(DivideParcel, AParcelInsideACellIsThereAlone) {
  const BedMesh mesh = testing::BoxMesh{{2, 2, 2}}.make();
  const CellLocator locator(mesh);
  std::vector<CellShare> shares;
  std::int64_t guess = -1;
  ASSERT_EQ(divide_parcel(locator, {0.25, 0.25, 0.25}, 0.2, guess, shares), 1U);
  EXPECT_EQ(shares[0].cell, 0);
  EXPECT_EQ(guess, 0);
  EXPECT_EQ(shares[0].share, 1);
}

TEST(DivideParcel, HalvesOnAFaceAndEighthsOnACorner) {
  const BedMesh mesh = testing::BoxMesh{{2, 2, 2}}.make();
  const CellLocator locator(mesh);
  std::vector<CellShare> shares;
  std::int64_t guess = -1;
  divide_parcel(locator, {0.5 + 1e-6, 0.25, 0.25}, 0.2, guess, shares);
  ASSERT_EQ(shares.size(), 2U);
  EXPECT_NEAR(shares[0].share, 0.5, 0.21);
  divide_parcel(locator, {0.5 + 1e-6, 0.5 + 1e-6, 0.5 + 1e-6}, 0.2, guess, shares);
  EXPECT_EQ(shares.size(), 8U);
}

TEST(DivideParcel, CentroidAndSpreadAreTheSpheres) {
  // On a mesh much finer than the parcel the shares are the satellite points themselves.
  const BedMesh mesh = testing::BoxMesh{{40, 40, 40}, {-1, -1, -1}, {1, 1, 1}}.make();
  const CellLocator locator(mesh);
  std::vector<CellShare> shares;
  std::int64_t guess = -1;
  const double radius = 0.8;
  divide_parcel(locator, {0, 0, 0}, radius, guess, shares);
  for (std::size_t axis = 0; axis < 3; ++axis) {
    double mean = 0, variance = 0;
    for (const auto& [cell, share] : shares) {
      mean += share * mesh.cell_centre[cell][axis];
      variance += share * mesh.cell_centre[cell][axis] * mesh.cell_centre[cell][axis];
    }
    EXPECT_NEAR(mean, 0, 0.026);
    EXPECT_NEAR(variance, radius * radius / 5, 0.03 * radius * radius);
  }
}

TEST(DivideParcel, WrapsAcrossPeriodicSides) {
  const BedMesh mesh = testing::BoxMesh{{1, 4, 1}, {-1, -1, -1}, {1, 1, 1}, true}.make();
  const CellLocator locator(mesh);
  std::vector<CellShare> shares;
  std::int64_t guess = -1;
  divide_parcel(locator, {0, 0.99, 0}, 0.2, guess, shares);
  ASSERT_EQ(shares.size(), 2U);
  EXPECT_EQ(shares[0].cell, 3);
  EXPECT_EQ(shares[1].cell, 0);
}

TEST(DivideParcel, NothingOutsideTheMesh) {
  const BedMesh mesh = testing::BoxMesh{}.make();
  const CellLocator locator(mesh);
  std::vector<CellShare> shares{{0, 1}};
  std::int64_t guess = 3;
  EXPECT_EQ(divide_parcel(locator, {0.5, 0.5, 1.2}, 0.1, guess, shares), 0U);
  EXPECT_TRUE(shares.empty());
  EXPECT_EQ(guess, -1);
}

TEST(DivideParcel, WhatSticksOutOfAWallStaysInTheCentresCell) {
  const BedMesh mesh = testing::BoxMesh{{2, 2, 2}}.make();
  const CellLocator locator(mesh);
  std::vector<CellShare> shares;
  std::int64_t guess = -1;
  ASSERT_EQ(divide_parcel(locator, {0.05, 0.25, 0.25}, 0.2, guess, shares), 1U);
  EXPECT_EQ(shares[0].share, 1);
}

}  // namespace
}  // namespace cupola
