#include "physics/projection/clean_field.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <numeric>
#include <random>

#include "physics/equations/face_geometry.hpp"
#include "schemas/failure.hpp"
#include "tests/support/foam_scene.hpp"
#include "tests/support/furnaces.hpp"

namespace cupola {
namespace {

constexpr double descent = 2e-3;  // m/s
constexpr double pi = std::numbers::pi;

/// What leaves the mesh below, as sinks of the cells there.
std::vector<double> bottom_sinks(const BedMesh& mesh) {
  std::vector<double> sink(mesh.cells(), 0);
  for (const auto& patch : mesh.patches) {
    for (auto face = patch.first_face; face < patch.first_face + patch.faces; ++face) {
      if (mesh.face_area[face][2] >= 0) continue;
      sink[mesh.face_owner[face]] -= descent * mesh.face_area[face][2] / mesh.cell_volume[mesh.face_owner[face]];
    }
  }
  return sink;
}

RawGranularField uniform_descent(const BedMesh& mesh) {
  RawGranularField raw;
  raw.coke_flux.assign(mesh.cells(), {0, 0, -descent});
  raw.sink = bottom_sinks(mesh);
  raw.bed.assign(mesh.cells(), true);
  return raw;
}

double rms_difference(const std::vector<Vector3>& a, const std::vector<Vector3>& b) {
  double sum = 0;
  for (std::size_t i = 0; i < a.size(); ++i) {
    for (std::size_t axis = 0; axis < 3; ++axis) sum += std::pow(a[i][axis] - b[i][axis], 2);
  }
  return std::sqrt(sum / static_cast<double>(a.size()));
}

/// Largest wrong divergence over the largest sink.
double wrong_divergence(const BedMesh& mesh, const RawGranularField& raw, const CleanGranularField& clean) {
  const auto outflow = FaceGeometry::outflow(mesh, clean.face_flux);
  double wrong = 0, usual = 0;
  for (std::size_t cell = 0; cell < mesh.cells(); ++cell) {
    if (!raw.bed[cell]) continue;
    const double sink = raw.sink[cell] * mesh.cell_volume[cell];
    wrong = std::max(wrong, std::abs(outflow[cell] + sink));
    usual = std::max(usual, std::abs(sink));
  }
  return wrong / usual;
}

TEST(CleanField, AUniformFieldStaysAsItIs) {
  FoamScene scene(furnaces::box());
  auto raw = uniform_descent(scene.mesh);
  raw.smoothing_passes = 4;
  const auto clean = clean_granular_field(scene.foam, scene.mesh, raw);
  for (std::size_t face = 0; face < scene.mesh.faces(); ++face) {
    const bool wall = scene.mesh.face_neighbour[face] < 0 && scene.mesh.face_area[face][2] <= 0;
    const double expected = wall ? 0 : -descent * scene.mesh.face_area[face][2];
    EXPECT_NEAR(clean.face_flux[face], expected, 1e-14 * descent);
  }
}

/// The box's descent with a swirl in it that no wall notices.
std::vector<Vector3> swirling_descent(const BedMesh& mesh) {
  std::vector<Vector3> field(mesh.cells());
  for (std::size_t cell = 0; cell < mesh.cells(); ++cell) {
    const double x = (mesh.cell_centre[cell][0] + 0.3) / 0.6, z = mesh.cell_centre[cell][2] / 1.5;
    const double strength = 0.2 * descent;
    field[cell] = {-strength / 1.5 * std::sin(pi * x) * std::cos(pi * z), 0,
                   strength / 0.6 * std::cos(pi * x) * std::sin(pi * z) - descent};
  }
  return field;
}

std::vector<Vector3> with_noise(std::vector<Vector3> field, double share) {
  std::mt19937_64 generator(7);
  std::normal_distribution<double> noise(0, share * descent);
  for (auto& vector : field) {
    for (double& part : vector) part += noise(generator);
  }
  return field;
}

TEST(CleanField, RecoversADivergenceFreeFieldFromNoise) {
  auto campaign = furnaces::box();
  campaign.scene.mesh.cell = 0.05;
  FoamScene scene(campaign);
  const FaceGeometry geometry(scene.mesh);
  const auto exact = swirling_descent(scene.mesh);
  auto raw = uniform_descent(scene.mesh);
  raw.coke_flux = with_noise(exact, 0.3);
  const double error_raw = rms_difference(raw.coke_flux, exact);
  const auto projected = clean_granular_field(scene.foam, scene.mesh, raw);
  const double error_projected = rms_difference(geometry.cell_vectors(scene.mesh, projected.face_flux), exact);
  raw.smoothing_passes = 4;
  const auto clean = clean_granular_field(scene.foam, scene.mesh, raw);
  const double error_clean = rms_difference(geometry.cell_vectors(scene.mesh, clean.face_flux), exact);
  RecordProperty("raw", std::to_string(error_raw / descent));
  RecordProperty("projected", std::to_string(error_projected / descent));
  RecordProperty("smoothed and projected", std::to_string(error_clean / descent));
  EXPECT_LT(error_projected, 0.8 * error_raw);
  EXPECT_LT(error_clean, 0.4 * error_raw);
  EXPECT_LT(clean.error_after, 1e-9);
  EXPECT_GT(clean.error_before, 0.1);
  EXPECT_GT(clean.change, 0.1);
  EXPECT_LT(wrong_divergence(scene.mesh, raw, clean), 1e-10);
}

/// The shaft with a freeboard, periodic sides and two raceways, and a noisy field that is wrong everywhere.
class Shaft : public ::testing::Test {
 protected:
  Shaft() {
    const BedMesh& mesh = scene.mesh;
    raw.coke_flux.assign(mesh.cells(), {0, 0, -descent});
    raw.coke_flux = with_noise(raw.coke_flux, 0.5);
    raw.sink.assign(mesh.cells(), 0);
    raw.bed.assign(mesh.cells(), false);
    for (std::size_t cell = 0; cell < mesh.cells(); ++cell) {
      const Vector3& c = mesh.cell_centre[cell];
      raw.bed[cell] = c[2] < 6.1;
      if (std::abs(c[0]) > 0.9 && std::abs(c[2] - 0.06) < 0.3) raw.sink[cell] = 5e-3;
    }
    raw.smoothing_passes = 3;
  }
  FoamScene scene{furnaces::shaft()};
  RawGranularField raw;
};

TEST_F(Shaft, ProjectionIsExactAndNothingCrossesAWall) {
  const auto clean = clean_granular_field(scene.foam, scene.mesh, raw);
  EXPECT_LT(wrong_divergence(scene.mesh, raw, clean), 1e-10);
  double inflow = 0;
  for (std::size_t face = 0; face < scene.mesh.faces(); ++face) {
    const auto owner = scene.mesh.face_owner[face];
    const auto neighbour = scene.mesh.face_neighbour[face];
    if (neighbour < 0) {
      EXPECT_EQ(clean.face_flux[face], 0);
    } else if (raw.bed[owner] != raw.bed[neighbour]) {
      const double into = raw.bed[owner] ? -clean.face_flux[face] : clean.face_flux[face];
      EXPECT_GE(into, 0);
      inflow += into;
    } else if (!raw.bed[owner]) {
      EXPECT_EQ(clean.face_flux[face], 0);
    }
    const auto partner = scene.mesh.face_partner[face];
    if (partner >= 0) {
      EXPECT_NEAR(clean.face_flux[face], -clean.face_flux[partner], 1e-18);
    }
  }
  const double removed = std::inner_product(raw.sink.begin(), raw.sink.end(), scene.mesh.cell_volume.begin(), 0.0);
  EXPECT_NEAR(inflow, removed, 1e-12 * removed);
}

TEST_F(Shaft, MirrorSymmetryOnDemand) {
  raw.mirror_symmetric = true;
  const auto clean = clean_granular_field(scene.foam, scene.mesh, raw);
  const auto cells = FaceGeometry(scene.mesh).cell_vectors(scene.mesh, clean.face_flux);
  double sideways = 0;
  for (std::size_t cell = 0; cell < scene.mesh.cells(); ++cell)
    sideways += cells[cell][0] * scene.mesh.cell_volume[cell];
  EXPECT_NEAR(sideways, 0, 1e-12);
  EXPECT_LT(wrong_divergence(scene.mesh, raw, clean), 1e-10);
}

TEST_F(Shaft, WithoutAFieldTheInflowIsUniform) {
  raw.coke_flux.assign(scene.mesh.cells(), {0, 0, 0});
  const auto clean = clean_granular_field(scene.foam, scene.mesh, raw);
  std::vector<double> speeds;
  for (std::size_t face = 0; face < scene.mesh.internal_faces(); ++face) {
    if (raw.bed[scene.mesh.face_owner[face]] && !raw.bed[scene.mesh.face_neighbour[face]]) {
      speeds.push_back(clean.face_flux[face] / scene.mesh.face_area[face][2]);
    }
  }
  ASSERT_FALSE(speeds.empty());
  for (const double speed : speeds) EXPECT_NEAR(speed, speeds.front(), 1e-12 * std::abs(speed));
  EXPECT_LT(speeds.front(), 0);
}

TEST_F(Shaft, WithoutABedItSaysSo) {
  raw.bed.assign(scene.mesh.cells(), false);
  EXPECT_THROW(clean_granular_field(scene.foam, scene.mesh, raw), Failure);
}

}  // namespace
}  // namespace cupola
