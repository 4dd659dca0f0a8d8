#include "physics/mesh/cell_locator.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>

#include "physics/mesh/prepare.hpp"
#include "schemas/files.hpp"
#include "tests/support/furnaces.hpp"
#include "tests/support/temporary_folder.hpp"

namespace cupola {
namespace {

class CellLocatorTest : public testing::Test {
 protected:
  static void SetUpTestSuite() {
    const TemporaryFolder folder;
    Task task;
    task.campaign = furnaces::shaft();
    task.campaign_hash = hash_text("shaft");
    prepare(folder.path(), task);
    mesh = std::make_unique<BedMesh>(BedMesh::read(folder.path() / "foam" / "mesh.hdf"));
  }
  static void TearDownTestSuite() { mesh.reset(); }

  /// How far outside a cell's faces a point lies, m; negative inside.
  static double outside_by(std::size_t cell, const Vector3& point) {
    double farthest = -std::numeric_limits<double>::max();
    for (const std::int64_t number : mesh->cell_faces[cell]) {
      const auto face = static_cast<std::size_t>(number);
      const double sign = mesh->face_owner[face] == static_cast<std::int64_t>(cell) ? 1 : -1;
      const Vector3& area = mesh->face_area[face];
      double product = 0;
      for (std::size_t i = 0; i < 3; ++i) product += sign * area[i] * (point[i] - mesh->face_centre[face][i]);
      farthest = std::max(farthest, product / std::hypot(area[0], area[1], area[2]));
    }
    return farthest;
  }

  static std::int64_t brute_force(const Vector3& point) {
    std::int64_t best = -1;
    double least = 1e-12;
    for (std::size_t cell = 0; cell < mesh->cells(); ++cell) {
      const double outside = outside_by(cell, point);
      if (outside < least) {
        least = outside;
        best = static_cast<std::int64_t>(cell);
      }
    }
    return best;
  }

  static std::unique_ptr<BedMesh> mesh;
};
std::unique_ptr<BedMesh> CellLocatorTest::mesh;

TEST_F(CellLocatorTest, FindsEveryCentreWithAnyGuess) {
  const CellLocator locator(*mesh);
  for (std::size_t cell = 0; cell < mesh->cells(); ++cell) {
    const auto wanted = static_cast<std::int64_t>(cell);
    EXPECT_EQ(locator.find(mesh->cell_centre[cell]), wanted);
    EXPECT_EQ(locator.find(mesh->cell_centre[cell], wanted), wanted);
    EXPECT_EQ(locator.find(mesh->cell_centre[cell], 0), wanted);
    EXPECT_EQ(locator.nearest(mesh->cell_centre[cell]), wanted);
  }
}

TEST_F(CellLocatorTest, AgreesWithLookingIntoEveryCell) {
  const CellLocator locator(*mesh);
  std::mt19937_64 random(5);
  std::uniform_real_distribution<double> x(-2.2, 2.2);
  std::uniform_real_distribution<double> y(-0.3, 0.3);
  std::uniform_real_distribution<double> z(-0.8, 7.9);
  std::int64_t guess = -1;
  int inside = 0;
  for (int i = 0; i < 3000; ++i) {
    const Vector3 point{x(random), y(random), z(random)};
    const std::int64_t found = locator.find(point, guess);
    EXPECT_EQ(found, brute_force(point)) << point[0] << ' ' << point[1] << ' ' << point[2];
    guess = found;
    inside += found >= 0 ? 1 : 0;
  }
  EXPECT_GT(inside, 1500);
  EXPECT_LT(inside, 2500);
}

TEST_F(CellLocatorTest, CornersAndEdgesBelongToACellThatTouchesThem) {
  const CellLocator locator(*mesh);
  for (const Vector3& point : mesh->points) {
    const std::int64_t cell = locator.find(point);
    ASSERT_GE(cell, 0);
    EXPECT_LT(outside_by(static_cast<std::size_t>(cell), point), 1e-9);
  }
}

TEST_F(CellLocatorTest, WrapsAlongTheDepth) {
  const CellLocator locator(*mesh);
  EXPECT_EQ(locator.find({0.1, 0.35, 3.0}), locator.find({0.1, -0.25, 3.0}));
  EXPECT_EQ(locator.find({0.1, -2.95, 3.0}), locator.find({0.1, 0.05, 3.0}));
  EXPECT_GE(locator.find({0.1, 0.3, 3.0}), 0);
}

TEST_F(CellLocatorTest, OutsideIsNowhereButMayBeNearACell) {
  const CellLocator locator(*mesh);
  EXPECT_EQ(locator.find({1.6, 0, 0.1}), -1);
  EXPECT_EQ(locator.find({0, 0, 7.61}), -1);
  EXPECT_EQ(locator.find({std::nan(""), 0, 1}), -1);
  const std::int64_t near = locator.nearest({1.52, 0, 0.1});
  ASSERT_GE(near, 0);
  EXPECT_NEAR(mesh->cell_centre[static_cast<std::size_t>(near)][0], 1.4, 0.1);
  EXPECT_EQ(locator.nearest({0, 0, 30}), -1);
  EXPECT_EQ(locator.nearest({std::nan(""), 0, 1}), -1);
}

}  // namespace
}  // namespace cupola
