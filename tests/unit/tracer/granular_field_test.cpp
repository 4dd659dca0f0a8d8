#include "stage_tracer/granular_field.hpp"

#include <gtest/gtest.h>

#include <algorithm>

#include "physics/projection/bed_state.hpp"
#include "schemas/failure.hpp"
#include "stage_tracer/bed_composition.hpp"
#include "tests/support/box_mesh.hpp"
#include "tests/support/furnaces.hpp"

namespace cupola {
namespace {

class GranularFieldTest : public ::testing::Test {
 protected:
  GranularFieldTest() {
    testing::BoxMesh box;
    box.cells = {6, 3, 10};
    box.lower = {-0.6, -0.3, 0};
    box.upper = {0.6, 0.3, 2};
    box.periodic_y = true;
    mesh_ = box.make();
    campaign_.scene.geometry.profile = {{0, 0.6}, {2, 0.6}};
    campaign_.scene.geometry.depth = 0.6;
    campaign_.charging.stock_line = 1.6;
    campaign_.charging.layers = {{{"coke", 80.0}}, {{"ore", 150.0}}};
    campaign_.species[1].softening = Softening{1475, 1675};
    campaign_.species[1].none_below = 0.3;
    bed_ = bed_cells(mesh_, campaign_);
  }

  Campaign campaign_ = furnaces::shaft();
  BedMesh mesh_;
  std::vector<bool> bed_;
};

TEST_F(GranularFieldTest, BedEndsAtTheStockLine) {
  EXPECT_EQ(std::count(bed_.begin(), bed_.end(), true), 6 * 3 * 8);
  campaign_.charging.stock_line = 2.5;
  const auto all = bed_cells(mesh_, campaign_);
  EXPECT_EQ(std::count(all.begin(), all.end(), true), 6 * 3 * 10);
}

TEST_F(GranularFieldTest, UniformDescentFlowsThroughTheStockPlaneAlone) {
  const std::vector<Vector3> flux(mesh_.cells(), Vector3{0, 0, -1e-3});
  const auto face_flux = interpolate_flux(mesh_, bed_, flux);
  std::vector<double> outflow(mesh_.cells(), 0.0);
  for (std::size_t f = 0; f < mesh_.faces(); ++f) {
    outflow[static_cast<std::size_t>(mesh_.face_owner[f])] += face_flux[f];
    if (f < mesh_.internal_faces()) outflow[static_cast<std::size_t>(mesh_.face_neighbour[f])] -= face_flux[f];
  }
  for (std::size_t c = 0; c < mesh_.cells(); ++c) {
    const double z = mesh_.cell_centre[c][2];
    const bool inside = bed_[c] && z > 0.2;  // the bottom is a wall: what comes down stays there
    EXPECT_NEAR(outflow[c], inside || z > 1.8 ? 0 : (z < 0.2 ? -1e-3 * 0.04 : 1e-3 * 0.04), 1e-15) << z;
  }
  const auto faces = stock_faces(mesh_, bed_, face_flux, 7.0);
  ASSERT_EQ(faces.size(), 18U);
  for (const StockFace& face : faces) {
    EXPECT_NEAR(face.volume_rate, 7.0 / 18, 1e-12);
    EXPECT_TRUE(bed_[static_cast<std::size_t>(face.cell)]);
  }
}

TEST_F(GranularFieldTest, StockPlaneAtTheTopIsTheOutlet) {
  campaign_.charging.stock_line = 3;
  const auto all = bed_cells(mesh_, campaign_);
  const std::vector<Vector3> flux(mesh_.cells(), Vector3{0, 0, -1e-3});
  EXPECT_EQ(stock_faces(mesh_, all, interpolate_flux(mesh_, all, flux), 1.0).size(), 18U);
}

TEST_F(GranularFieldTest, BedThatRisesIsRefused) {
  const std::vector<Vector3> flux(mesh_.cells(), Vector3{0, 0, 1e-3});
  EXPECT_THROW(stock_faces(mesh_, bed_, interpolate_flux(mesh_, bed_, flux), 1.0), Failure);
}

TEST_F(GranularFieldTest, RacewaysShareTheirSinkByWeightAndVolume) {
  campaign_.raceways = {Raceway{{Vector3{-0.6, -0.3, 0}, Vector3{-0.2, 0.3, 0.4}}, 0.75, 1},
                        Raceway{{Vector3{0.2, -0.3, 0}, Vector3{0.6, 0.3, 0.4}}, 0.75, 1}};
  const auto sink = raceway_sink(mesh_, campaign_, bed_, {3, 1}, 0.8);
  double left = 0;
  double right = 0;
  for (std::size_t c = 0; c < mesh_.cells(); ++c)
    (mesh_.cell_centre[c][0] < 0 ? left : right) += sink[c] * mesh_.cell_volume[c];
  EXPECT_NEAR(left, 0.6, 1e-12);
  EXPECT_NEAR(right, 0.2, 1e-12);
  campaign_.raceways[0].box = {Vector3{5, 5, 5}, Vector3{6, 6, 6}};
  EXPECT_THROW(raceway_sink(mesh_, campaign_, bed_, {1, 1}, 1), Failure);
}

TEST_F(GranularFieldTest, LastingShareIsTheChargesUntilTheOreHasMelted) {
  std::vector<double> ore(mesh_.cells());
  for (std::size_t c = 0; c < mesh_.cells(); ++c) ore[c] = 2000 - 500 * mesh_.cell_centre[c][2];
  const auto share = persistent_share(mesh_, campaign_, 0.6, ore);
  for (std::size_t c = 0; c < mesh_.cells(); ++c) {
    const bool molten = mesh_.cell_centre[c][2] < 0.3 || ore[c] >= campaign_.species[1].softening->melted;
    EXPECT_EQ(share[c], molten ? 1.0 : 0.6);
  }
  for (Species& species : campaign_.species) species.softening.reset();
  for (const double f : persistent_share(mesh_, campaign_, 1.0, {})) EXPECT_EQ(f, 1.0);
}

TEST_F(GranularFieldTest, PackingIsTakenBelowTheRaggedSurface) {
  std::vector<double> fraction(mesh_.cells(), 0.0);
  for (std::size_t c = 0; c < mesh_.cells(); ++c) {
    const double z = mesh_.cell_centre[c][2];
    fraction[c] = z > 1.4 ? 0.2 : (z > 0.8 ? 0.58 : 0.5);
  }
  EXPECT_NEAR(packing_near_stock(mesh_, campaign_, bed_, fraction), 0.58, 1e-12);
  EXPECT_THROW(packing_near_stock(mesh_, campaign_, bed_, std::vector<double>(mesh_.cells(), 0.0)), Failure);
}

TEST_F(GranularFieldTest, CompositionKeepsThePackingAndFillsItAsTheOreSoftens) {
  GranularField field;
  field.bed = bed_;
  field.solids_fraction.assign(mesh_.cells(), 0.5);
  field.contact_fraction.assign(mesh_.cells(), 0.56);
  CellContents contents;
  contents.volume = {std::vector<double>(mesh_.cells(), 1e-3), std::vector<double>(mesh_.cells(), 3e-3)};
  contents.temperature = {std::vector<double>(mesh_.cells(), 1600.0), std::vector<double>(mesh_.cells(), 1400.0)};
  contents.temperature[1][5] = 1675;                  // wholly softened
  contents.volume[0][7] = contents.volume[1][7] = 0;  // no tracer here
  const BySpecies volume = bed_composition(mesh_, campaign_, field, contents, {1, 0});
  const auto solids = solids_fraction(mesh_, volume);
  EXPECT_NEAR(solids[3], 0.56, 1e-12);
  EXPECT_NEAR(volume[1][3] / volume[0][3], 3, 1e-12);
  // Of four parts of material, three take only 0.64 of their volume of the packing.
  EXPECT_NEAR(solids[5], 0.56 * 4 / (1 + 3 * 0.64), 1e-12);
  EXPECT_NEAR(solids[7], 0.5, 1e-12);
  EXPECT_EQ(volume[1][7], 0);
  EXPECT_EQ(solids[6 * 3 * 8], 0);  // above the stock plane
}

}  // namespace
}  // namespace cupola
