#include "physics/projection/bed_state.hpp"

#include <gtest/gtest.h>

#include <limits>

#include "physics/closures/drag_beetstra.hpp"
#include "schemas/failure.hpp"
#include "tests/support/box_mesh.hpp"

namespace cupola {
namespace {

Campaign coke_and_ore() {
  Campaign campaign;
  Species coke, ore;
  coke.name = "coke";
  coke.diameter = 0.044;
  ore.name = "ore";
  ore.diameter = 0.015;
  campaign.species = {coke, ore};
  return campaign;
}

const BedMesh& mesh() {
  static const BedMesh box = testing::BoxMesh{{2, 1, 2}, {0, 0, 0}, {2, 1, 2}}.make();
  return box;
}

TEST(BedState, VoidFractionAndSauterDiameter) {
  const auto bed = bed_state(mesh(), coke_and_ore(), {{0.3, 0.5, 0, 0.2}, {0.3, 0, 0, 0.2}});
  EXPECT_DOUBLE_EQ(bed.void_fraction[0], 0.4);
  EXPECT_DOUBLE_EQ(bed.void_fraction[1], 0.5);
  EXPECT_DOUBLE_EQ(bed.void_fraction[2], 1);
  EXPECT_DOUBLE_EQ(bed.grain_diameter[0], 2 / (1 / 0.044 + 1 / 0.015));
  EXPECT_DOUBLE_EQ(bed.grain_diameter[1], 0.044);
  EXPECT_EQ(bed.cells_at_floor, 0);
  for (const double factor : bed.polydispersity) EXPECT_EQ(factor, 1);
}

TEST(BedState, BeetstraKnowsThatGrainsDiffer) {
  auto campaign = coke_and_ore();
  campaign.drag = DragLaw::beetstra;
  const auto bed = bed_state(mesh(), campaign, {{0.3, 0.5, 0, 0.2}, {0.3, 0, 0, 0.2}});
  EXPECT_DOUBLE_EQ(bed.polydispersity[0], beetstra_polydispersity(0.5 * (0.044 + 0.015) / bed.grain_diameter[0]));
  EXPECT_GT(bed.polydispersity[0], 1);
  EXPECT_DOUBLE_EQ(bed.polydispersity[1], 1);
  EXPECT_DOUBLE_EQ(bed.polydispersity[2], 1);
}

TEST(BedState, DenseCellsAreFlooredAndCounted) {
  const auto bed = bed_state(mesh(), coke_and_ore(), {{0.95, 0.5, 1.2, 0.2}, {0, 0, 0, 0}});
  EXPECT_DOUBLE_EQ(bed.void_fraction[0], least_void_fraction);
  EXPECT_DOUBLE_EQ(bed.void_fraction[2], least_void_fraction);
  EXPECT_EQ(bed.cells_at_floor, 2);
}

TEST(BedState, RacewaysHoldAVoid) {
  auto campaign = coke_and_ore();
  Raceway raceway;
  raceway.box = {Vector3{0, 0, 0}, Vector3{1, 1, 1}};
  raceway.void_fraction = 0.75;
  campaign.raceways = {raceway};
  EXPECT_EQ(raceway_cells(mesh(), raceway), std::vector<std::int64_t>{0});
  const auto bed = bed_state(mesh(), campaign, {{0.5, 0.5, 0.1, 0.1}, {0, 0, 0, 0}});
  EXPECT_DOUBLE_EQ(bed.void_fraction[0], 0.75);
  EXPECT_DOUBLE_EQ(bed.void_fraction[1], 0.5);
}

TEST(BedState, BadVolumesNameTheCell) {
  for (const double wrong : {-0.1, std::numeric_limits<double>::quiet_NaN()}) {
    try {
      bed_state(mesh(), coke_and_ore(), {{0.5, 0.5, wrong, 0.1}, {0, 0, 0, 0}});
      FAIL();
    } catch (const Failure& failure) {
      EXPECT_EQ(failure.code(), ExitCode::diverged);
      EXPECT_EQ(failure.where().at("cell"), "2");
    }
  }
}

}  // namespace
}  // namespace cupola
