#include "physics/mesh/wall_triangles.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <set>

#include "physics/mesh/bed_mesh.hpp"
#include "physics/mesh/prepare.hpp"
#include "physics/mesh/wall_check.hpp"
#include "schemas/failure.hpp"
#include "schemas/files.hpp"
#include "tests/support/furnaces.hpp"
#include "tests/support/temporary_folder.hpp"

namespace cupola {
namespace {

using Key = std::array<long, 3>;

Key key_of(const Vector3& point) {
  return {std::lround(point[0] * 1e9), std::lround(point[1] * 1e9), std::lround(point[2] * 1e9)};
}

/// Directed edges and how often each occurs.
std::map<std::pair<Key, Key>, int> edges_of(const std::vector<Triangle>& triangles) {
  std::map<std::pair<Key, Key>, int> edges;
  for (const Triangle& t : triangles) {
    for (std::size_t i = 0; i < 3; ++i) ++edges[{key_of(t[i]), key_of(t[(i + 1) % 3])}];
  }
  return edges;
}

Vector3 area_of(const Triangle& t) {
  Vector3 u{};
  Vector3 v{};
  for (std::size_t i = 0; i < 3; ++i) {
    u[i] = t[1][i] - t[0][i];
    v[i] = t[2][i] - t[0][i];
  }
  return {(u[1] * v[2] - u[2] * v[1]) / 2, (u[2] * v[0] - u[0] * v[2]) / 2, (u[0] * v[1] - u[1] * v[0]) / 2};
}

/// Every edge has its opposite, except where the surface is open on purpose.
template <typename Open>
void expect_tight(const std::vector<Triangle>& triangles, const Open& open) {
  const auto edges = edges_of(triangles);
  int open_edges = 0;
  for (const auto& [edge, times] : edges) {
    EXPECT_EQ(times, 1);
    if (edges.contains({edge.second, edge.first})) continue;
    ++open_edges;
    EXPECT_TRUE(open(edge.first) && open(edge.second)) << edge.first[0] << ' ' << edge.first[1] << ' ' << edge.first[2];
  }
  EXPECT_GT(open_edges, 0);
}

void expect_short_edges(const std::vector<Triangle>& triangles) {
  for (const Triangle& t : triangles) {
    for (std::size_t i = 0; i < 3; ++i) {
      const Vector3& a = t[i];
      const Vector3& b = t[(i + 1) % 3];
      EXPECT_LE(std::hypot(a[0] - b[0], a[1] - b[1], a[2] - b[2]), 0.5);
    }
  }
}

TEST(WallTriangles, TightExceptAtTheTopAndPeriodicSides) {
  for (const Campaign& campaign : {furnaces::shaft(), furnaces::paper()}) {
    const std::vector<Triangle> triangles = wall_triangles(campaign);
    expect_short_edges(triangles);
    const long side = std::lround(campaign.scene.geometry.depth / 2 * 1e9);
    const long top = std::lround(campaign.hopper_top() * 1e9);
    expect_tight(triangles, [&](const Key& point) { return std::abs(point[1]) == side || point[2] == top; });
  }
}

TEST(WallTriangles, BoxIsTightExceptAtTheTop) {
  const Campaign campaign = furnaces::box();
  const std::vector<Triangle> triangles = wall_triangles(campaign);
  expect_short_edges(triangles);
  expect_tight(triangles, [&](const Key& point) { return point[2] == std::lround(campaign.hopper_top() * 1e9); });
  // A closed box less its lid: the area vectors add up to the lid's, looking down.
  Vector3 sum{};
  for (const Triangle& t : triangles) {
    for (std::size_t i = 0; i < 3; ++i) sum[i] += area_of(t)[i];
  }
  EXPECT_NEAR(sum[0], 0, 1e-12);
  EXPECT_NEAR(sum[1], 0, 1e-12);
  EXPECT_NEAR(sum[2], -0.6 * 0.4, 1e-12);
}

TEST(WallTriangles, AreTheMeshsOwnWallsWithTheTuyeresClosed) {
  const TemporaryFolder folder;
  Campaign campaign = furnaces::shaft();
  campaign.charging.hopper_height = 0;
  Task task;
  task.campaign = campaign;
  prepare(folder.path(), task);
  const BedMesh mesh = BedMesh::read(folder.path() / "foam" / "mesh.hdf");
  // Areas by direction agree, and every corner of a wall face lies on a triangle's plane within its height.
  Vector3 wall{};
  double wall_area = 0;
  for (const BedMesh::Patch& patch : mesh.patches) {
    if (patch.kind != BedMesh::PatchKind::wall && patch.kind != BedMesh::PatchKind::inlet) continue;
    for (std::int64_t i = patch.first_face; i < patch.first_face + patch.faces; ++i) {
      const Vector3& area = mesh.face_area[static_cast<std::size_t>(i)];
      for (std::size_t k = 0; k < 3; ++k) wall[k] += area[k];
      wall_area += std::hypot(area[0], area[1], area[2]);
    }
  }
  Vector3 stl{};
  double stl_area = 0;
  for (const Triangle& t : wall_triangles(campaign)) {
    const Vector3 area = area_of(t);
    for (std::size_t k = 0; k < 3; ++k) stl[k] += area[k];
    stl_area += std::hypot(area[0], area[1], area[2]);
  }
  EXPECT_NEAR(stl_area, wall_area, 1e-9 * wall_area);
  for (std::size_t k = 0; k < 3; ++k) EXPECT_NEAR(stl[k], wall[k], 1e-9);
  const std::string text = read_text(folder.path() / "foam" / "wall.stl");
  EXPECT_TRUE(text.starts_with("solid wall\n"));
  EXPECT_TRUE(text.ends_with("endsolid wall\n"));
}

TEST(WallTriangles, AHoleAnywhereIsFoundAndNamed) {
  const TemporaryFolder folder;
  for (const Campaign& campaign : {furnaces::shaft(), furnaces::paper(), furnaces::box()}) {
    const auto file = folder.path() / "wall.stl";
    write_stl(file, wall_triangles(campaign));
    const std::vector<Triangle> whole = read_stl(file);
    EXPECT_EQ(whole, wall_triangles(campaign));
    EXPECT_NO_THROW(check_walls(campaign, whole, "wall.stl"));
    for (std::size_t missing = 0; missing < whole.size(); missing += 7) {
      std::vector<Triangle> holed = whole;
      holed.erase(holed.begin() + static_cast<std::ptrdiff_t>(missing));
      EXPECT_THROW(check_walls(campaign, holed, "wall.stl"), Failure) << missing;
    }
    // A corner a millimetre off opens a crack.
    std::vector<Triangle> cracked = whole;
    cracked[whole.size() / 2][1][2] += 1e-3;
    try {
      check_walls(campaign, cracked, "wall.stl");
      FAIL() << "accepted";
    } catch (const Failure& failure) {
      EXPECT_EQ(failure.code(), ExitCode::wrong_input);
      EXPECT_NE(std::string(failure.what()).find("the wall has a hole at"), std::string::npos) << failure.what();
    }
  }
}

TEST(WallTriangles, AFileThatIsNoWallIsRefused) {
  const TemporaryFolder folder;
  const auto file = folder.path() / "wall.stl";
  for (const char* text : {"", "solid wall\nendsolid wall\n", "vertex 0 0 0\nvertex 1 0 0\n",
                           "vertex 0 0 0\nvertex 1 0 nan\nvertex 0 1 0\n", "vertex 0 0 0\nvertex 1 0 0\nvertex 0"}) {
    write_text_atomically(file, text);
    EXPECT_THROW(read_stl(file), Failure) << text;
  }
}

TEST(WallTriangles, HopperGoesOnAboveTheThroat) {
  const Campaign campaign = furnaces::paper();
  double highest = 0;
  for (const Triangle& t : wall_triangles(campaign)) {
    for (const Vector3& corner : t) {
      if (corner[2] > 26) {
        EXPECT_NEAR(std::abs(corner[0]), 4.7, 1e-12);
      }
      highest = std::max(highest, corner[2]);
    }
  }
  EXPECT_DOUBLE_EQ(highest, 28.5);
}

}  // namespace
}  // namespace cupola
