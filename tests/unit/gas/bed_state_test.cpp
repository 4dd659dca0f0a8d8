#include "physics/projection/bed_state.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "physics/closures/drag_beetstra.hpp"
#include "physics/closures/drag_filtered.hpp"
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
  for (const double factor : bed.drag_factor) EXPECT_EQ(factor, 1);
}

TEST(BedState, BeetstraKnowsThatGrainsDiffer) {
  auto campaign = coke_and_ore();
  campaign.drag = DragLaw::beetstra;
  const auto bed = bed_state(mesh(), campaign, {{0.3, 0.5, 0, 0.2}, {0.3, 0, 0, 0.2}});
  EXPECT_DOUBLE_EQ(bed.drag_factor[0], beetstra_polydispersity(0.5 * (0.044 + 0.015) / bed.grain_diameter[0]));
  EXPECT_GT(bed.drag_factor[0], 1);
  EXPECT_DOUBLE_EQ(bed.drag_factor[1], 1);
  EXPECT_DOUBLE_EQ(bed.drag_factor[2], 1);
}

TEST(BedState, FilteredDragCorrectsCoarseParcelsAndDiluteCoarseCells) {
  auto campaign = coke_and_ore();
  campaign.scene.gas.emplace().viscosity = 1.8e-5;
  for (auto& species : campaign.species) {
    species.diameter = 75e-6;
    species.density = 1500;
  }
  campaign.species[0].coarse_graining = 3;
  campaign.filtered_drag = FilteredDrag{0.1, true};
  const auto bed = bed_state(mesh(), campaign, {{0.3, 0.6, 0, 0.1}, {0, 0, 0, 0.1}});
  const double size = filter_size(1, 75e-6, 1500, 1.8e-5);
  EXPECT_NEAR(bed.drag_factor[0], std::exp(-0.2) * grid_drag_correction(size, 0.3), 1e-12);
  EXPECT_NEAR(bed.drag_factor[1], std::exp(-0.2), 1e-12);  // packed: no clusters
  EXPECT_EQ(bed.drag_factor[2], 1);
  EXPECT_NEAR(bed.drag_factor[3], std::exp(-0.1) * grid_drag_correction(size, 0.2), 1e-12);
  EXPECT_LT(bed.drag_factor[0], 0.3);
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
