#include "physics/mesh/prepare.hpp"

#include <gtest/gtest.h>

#include <chrono>
#include <cmath>
#include <cstdlib>
#include <fstream>
#include <numeric>
#include <thread>

#include "physics/mesh/bed_mesh.hpp"
#include "physics/plan/mesh_counts.hpp"
#include "schemas/failure.hpp"
#include "schemas/files.hpp"
#include "tests/support/furnaces.hpp"
#include "tests/support/temporary_folder.hpp"

namespace cupola {
namespace {

Task task_of(const Campaign& campaign) {
  Task task;
  task.campaign = campaign;
  task.campaign_hash = hash_text(campaign.name);
  task.program_version = "test";
  return task;
}

std::size_t index(std::int64_t i) { return static_cast<std::size_t>(i); }

double length(const Vector3& v) { return std::hypot(v[0], v[1], v[2]); }

double patch_area(const BedMesh& mesh, const std::string& name) {
  const BedMesh::Patch* patch = mesh.find_patch(name);
  double area = 0;
  for (std::int64_t i = 0; patch != nullptr && i < patch->faces; ++i) {
    area += length(mesh.face_area[index(patch->first_face + i)]);
  }
  return area;
}

void expect_sound(const BedMesh& mesh, const Campaign& campaign) {
  EXPECT_EQ(mesh.cells(), mesh_counts(campaign).cells());
  const double wanted = slot_volume(campaign, campaign.bottom(), campaign.top());
  EXPECT_NEAR(std::accumulate(mesh.cell_volume.begin(), mesh.cell_volume.end(), 0.0), wanted, 1e-12 * wanted);
  double largest_gap = 0;
  for (std::size_t cell = 0; cell < mesh.cells(); ++cell) {
    Vector3 sum{};
    double all = 0;
    for (const std::int64_t face : mesh.cell_faces[cell]) {
      const double sign = index(mesh.face_owner[index(face)]) == cell ? 1 : -1;
      for (std::size_t i = 0; i < 3; ++i) sum[i] += sign * mesh.face_area[index(face)][i];
      all += length(mesh.face_area[index(face)]);
    }
    largest_gap = std::max(largest_gap, length(sum) / all);
  }
  EXPECT_LT(largest_gap, 1e-14);
}

/// xi, eta, zeta run along x, y, z: opposite faces and the eight corners in VTK's order.
void expect_ordered(const BedMesh& mesh) {
  for (std::size_t cell = 0; cell < mesh.cells(); ++cell) {
    std::array<Vector3, 8> corner{};
    for (std::size_t k = 0; k < 8; ++k) corner[k] = mesh.points[index(mesh.cell_points[cell][k])];
    constexpr std::array<std::array<int, 3>, 8> place{
        {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}, {0, 0, 1}, {1, 0, 1}, {1, 1, 1}, {0, 1, 1}}};
    for (std::size_t a = 0; a < 8; ++a) {
      for (std::size_t b = 0; b < 8; ++b) {
        for (std::size_t axis = 0; axis < 3; ++axis) {
          const bool same_elsewhere = place[a][(axis + 1) % 3] == place[b][(axis + 1) % 3] &&
                                      place[a][(axis + 2) % 3] == place[b][(axis + 2) % 3];
          if (same_elsewhere && place[a][axis] < place[b][axis]) {
            ASSERT_LT(corner[a][axis], corner[b][axis]) << cell;
          }
        }
      }
      for (std::size_t axis = 0; axis < 3; ++axis) {
        const auto& face = mesh.face_points[index(mesh.cell_faces[cell][2 * axis + (place[a][axis] == 1 ? 1 : 0)])];
        ASSERT_NE(std::find(face.begin(), face.end(), mesh.cell_points[cell][a]), face.end()) << cell;
      }
    }
  }
}

TEST(FoamEnvironment, IsThereBeforeMainEvenWhereItWasNotGiven) {
  // ctest runs this program without the variable; the program has started itself anew with it.
  ASSERT_NE(std::getenv("WM_PROJECT_DIR"), nullptr);
  EXPECT_TRUE(std::filesystem::exists(std::filesystem::path(std::getenv("WM_PROJECT_DIR")) / "etc" / "controlDict"));
}

TEST(Prepare, MeshOfTheShaftIsExact) {
  const TemporaryFolder folder;
  const Campaign campaign = furnaces::shaft();
  const auto begin = std::chrono::steady_clock::now();
  prepare(folder.path(), task_of(campaign));
  RecordProperty("seconds",
                 std::to_string(std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count()));
  const BedMesh mesh = BedMesh::read(folder.path() / "foam" / "mesh.hdf");
  expect_sound(mesh, campaign);
  expect_ordered(mesh);
  EXPECT_NEAR(patch_area(mesh, "tuyere-left"), 0.0625, 1e-14);
  EXPECT_NEAR(patch_area(mesh, "tuyere-right"), 0.0625, 1e-14);
  EXPECT_NEAR(patch_area(mesh, "outlet"), 2.4 * 0.6, 1e-13);
  EXPECT_NEAR(patch_area(mesh, "bottom"), 3.0 * 0.6, 1e-13);
  EXPECT_EQ(mesh.find_patch("tuyere-left")->kind, BedMesh::PatchKind::inlet);
  EXPECT_EQ(mesh.find_patch("outlet")->kind, BedMesh::PatchKind::outlet);
  EXPECT_EQ(mesh.find_patch("front")->kind, BedMesh::PatchKind::periodic);
  EXPECT_EQ(mesh.find_patch("wall")->kind, BedMesh::PatchKind::wall);
  EXPECT_FALSE(std::filesystem::exists(folder.path() / "foam.partial"));
}

TEST(Prepare, StockLineAndTuyereEdgesArePlanesOfVertices) {
  const TemporaryFolder folder;
  prepare(folder.path(), task_of(furnaces::shaft()));
  const BedMesh mesh = BedMesh::read(folder.path() / "foam" / "mesh.hdf");
  for (const double level : {6.1, -0.065, 0.185, 0.2, 1.0}) {
    for (std::size_t cell = 0; cell < mesh.cells(); ++cell) {
      const double lower = mesh.points[index(mesh.cell_points[cell][0])][2];
      const double upper = mesh.points[index(mesh.cell_points[cell][6])][2];
      ASSERT_FALSE(lower < level - 1e-9 && upper > level + 1e-9) << "cell " << cell << " across " << level;
    }
  }
}

TEST(Prepare, PeriodicFacesArePairs) {
  const TemporaryFolder folder;
  prepare(folder.path(), task_of(furnaces::shaft()));
  const BedMesh mesh = BedMesh::read(folder.path() / "foam" / "mesh.hdf");
  EXPECT_DOUBLE_EQ(mesh.periodic_depth, 0.6);
  const BedMesh::Patch* front = mesh.find_patch("front");
  ASSERT_GT(front->faces, 0);
  for (std::int64_t i = 0; i < front->faces; ++i) {
    const std::size_t face = index(front->first_face + i);
    const std::size_t partner = index(mesh.face_partner[face]);
    EXPECT_EQ(index(mesh.face_partner[partner]), face);
    EXPECT_EQ(mesh.face_neighbour[face], mesh.face_owner[partner]);
    EXPECT_NEAR(mesh.face_centre[partner][0], mesh.face_centre[face][0], 1e-12);
    EXPECT_NEAR(mesh.face_centre[partner][1], mesh.face_centre[face][1] + 0.6, 1e-12);
    EXPECT_NEAR(mesh.face_centre[partner][2], mesh.face_centre[face][2], 1e-12);
  }
}

TEST(Prepare, BoxWithWallsIsBlownThroughItsBottom) {
  const TemporaryFolder folder;
  const Campaign campaign = furnaces::box();
  prepare(folder.path(), task_of(campaign));
  const BedMesh mesh = BedMesh::read(folder.path() / "foam" / "mesh.hdf");
  expect_sound(mesh, campaign);
  expect_ordered(mesh);
  EXPECT_EQ(mesh.cells(), 6U * 4U * 15U);
  EXPECT_EQ(mesh.find_patch("bottom"), nullptr);
  EXPECT_NEAR(patch_area(mesh, "blast"), 0.6 * 0.4, 1e-14);
  EXPECT_EQ(mesh.find_patch("front")->kind, BedMesh::PatchKind::wall);
  EXPECT_EQ(mesh.periodic_depth, 0);
  for (const std::int64_t partner : mesh.face_partner) EXPECT_EQ(partner, -1);
}

TEST(Prepare, SameCampaignGivesTheSameBytes) {
  const TemporaryFolder one;
  const TemporaryFolder two;
  prepare(one.path(), task_of(furnaces::box()));
  std::this_thread::sleep_for(std::chrono::milliseconds(1100));  // a time stamp in the file would differ
  prepare(two.path(), task_of(furnaces::box()));
  const BedMesh mesh = BedMesh::read(one.path() / "foam" / "mesh.hdf");
  EXPECT_EQ(mesh.hash, hash_file(two.path() / "foam" / "mesh.hdf"));
}

TEST(Prepare, IsDoneOnceForTheSameCampaignAndRanks) {
  const TemporaryFolder folder;
  Task task = task_of(furnaces::box());
  prepare(folder.path(), task);
  const auto written = std::filesystem::last_write_time(folder.path() / "foam" / "mesh.hdf");
  prepare(folder.path(), task);
  EXPECT_EQ(std::filesystem::last_write_time(folder.path() / "foam" / "mesh.hdf"), written);
  task.campaign.launch.ranks = 3;
  prepare(folder.path(), task);
  EXPECT_TRUE(std::filesystem::exists(folder.path() / "foam" / "processor2" / "constant" / "polyMesh" / "points"));
  task.campaign.scene.mesh.cell = 0.2;  // changed by hand, under the same hash
  prepare(folder.path(), task);
  EXPECT_EQ(BedMesh::read(folder.path() / "foam" / "mesh.hdf").cells(), mesh_counts(task.campaign).cells());
}

TEST(Prepare, SubdomainsAreBalanced) {
  const TemporaryFolder folder;
  Task task = task_of(furnaces::shaft());
  task.campaign.launch.ranks = 4;
  prepare(folder.path(), task);
  const auto cells = static_cast<double>(mesh_counts(task.campaign).cells());
  for (const char* part : {"processor0", "processor1", "processor2", "processor3"}) {
    std::ifstream file(folder.path() / "foam" / part / "constant" / "polyMesh" / "owner");
    std::string line;
    std::size_t found = 0;
    while (found == 0 && std::getline(file, line)) {
      const std::size_t at = line.find("nCells:");
      if (at != std::string::npos) found = std::stoul(line.substr(at + 7));
    }
    EXPECT_NEAR(static_cast<double>(found), cells / 4, 0.03 * cells / 4) << part;
  }
}

Failure failure_of(const Campaign& campaign) {
  const TemporaryFolder folder;
  try {
    prepare(folder.path(), task_of(campaign));
  } catch (const Failure& failure) {
    EXPECT_FALSE(std::filesystem::exists(folder.path() / "foam"));
    return failure;
  }
  ADD_FAILURE() << "prepared what cannot be";
  return Failure(ExitCode::done, "");
}

TEST(Prepare, RefusesATuyereTheMeshDoesNotHold) {
  Campaign below = furnaces::shaft();
  below.scene.gas->inlets[0].z = -0.45;
  EXPECT_EQ(failure_of(below).code(), ExitCode::wrong_input);
  EXPECT_NE(std::string(failure_of(below).what()).find("tuyere-left"), std::string::npos);
  Campaign wide = furnaces::shaft();
  wide.scene.gas->inlets[1].size[0] = 0.7;
  EXPECT_EQ(failure_of(wide).code(), ExitCode::wrong_input);
  Campaign overlapping = furnaces::shaft();
  overlapping.scene.gas->inlets[1].side = Inlet::Side::left;
  overlapping.scene.gas->inlets[1].z = 0.2;
  EXPECT_EQ(failure_of(overlapping).code(), ExitCode::wrong_input);
}

TEST(Prepare, RefusesSidesTooNearToEachOther) {
  Campaign campaign = furnaces::shaft();
  campaign.scene.geometry.depth = 0.36;
  EXPECT_EQ(failure_of(campaign).code(), ExitCode::wrong_input);
}

TEST(Prepare, RefusesInletNamesThatPatchesHaveAlready) {
  Campaign campaign = furnaces::shaft();
  campaign.scene.gas->inlets[0].name = "wall";
  EXPECT_EQ(failure_of(campaign).code(), ExitCode::wrong_input);
  campaign.scene.gas->inlets[0].name = "two words";
  EXPECT_EQ(failure_of(campaign).code(), ExitCode::wrong_input);
}

TEST(Prepare, TuyereOnAnInclinedWallAcrossACornerOfTheProfile) {
  const TemporaryFolder folder;
  Campaign campaign = furnaces::shaft();
  campaign.scene.gas->inlets[0].z = 1.0;
  prepare(folder.path(), task_of(campaign));
  const BedMesh mesh = BedMesh::read(folder.path() / "foam" / "mesh.hdf");
  expect_sound(mesh, campaign);
  const double below = std::hypot(0.125, 0.125 * 0.35 / 0.8);
  const double above = std::hypot(0.125, 0.125 * 0.65 / 5.5);
  EXPECT_NEAR(patch_area(mesh, "tuyere-left"), 0.25 * (below + above), 1e-12);
}

TEST(Prepare, PaperFurnaceHasItsCellsAndIsReadySoon) {
  const TemporaryFolder folder;
  const Campaign campaign = furnaces::paper();
  const auto begin = std::chrono::steady_clock::now();
  prepare(folder.path(), task_of(campaign));
  const double seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
  RecordProperty("seconds", std::to_string(seconds));
  const BedMesh mesh = BedMesh::read(folder.path() / "foam" / "mesh.hdf");
  EXPECT_EQ(mesh.cells(), 107008U);
  expect_sound(mesh, campaign);
  EXPECT_NEAR(patch_area(mesh, "tuyere-left"), 0.0625, 1e-13);
}

TEST(BedMesh, DamagedFileIsRefused) {
  const TemporaryFolder folder;
  prepare(folder.path(), task_of(furnaces::box()));
  const std::filesystem::path file = folder.path() / "foam" / "mesh.hdf";
  std::filesystem::resize_file(file, std::filesystem::file_size(file) / 2);
  EXPECT_THROW(BedMesh::read(file), Failure);
  EXPECT_THROW(BedMesh::read(folder.path() / "absent.hdf"), Failure);
}

}  // namespace
}  // namespace cupola
