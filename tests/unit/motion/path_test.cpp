#include "physics/motion/path.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <random>

#include "physics/mesh/cell_locator.hpp"
#include "schemas/failure.hpp"
#include "tests/support/structured_mesh.hpp"

namespace cupola {
namespace {

using Point = PathField::Point;
using End = PathField::End;

std::size_t index(std::int64_t i) { return static_cast<std::size_t>(i); }

double distance(const Vector3& a, const Vector3& b) { return std::hypot(a[0] - b[0], a[1] - b[1], a[2] - b[2]); }

/// A slot 0.6 m deep whose half width goes 1.5, 1.85, 1.2 m over 0, 1, 6 m: trapezoids extruded along y.
StructuredMesh slot() {
  return structured_mesh({16, 3, 30}, 0.6, [](const Vector3& r) {
    const double z = 6 * r[2];
    const double half_width = z < 1 ? 1.5 + 0.35 * z : 1.85 - 0.13 * (z - 1);
    return Vector3{half_width * (2 * r[0] - 1), 0.6 * (r[1] - 0.5), z};
  });
}

/// Hexahedra without a right angle: every inner plane of points bent.
StructuredMesh bent_cube() {
  return structured_mesh({6, 5, 7}, 0, [](const Vector3& r) {
    const double bump = 0.03 * std::sin(2 * std::numbers::pi * r[0]) * std::sin(2 * std::numbers::pi * r[1]) *
                        std::sin(2 * std::numbers::pi * r[2]);
    return Vector3{r[0] + bump + 0.2 * r[2], r[1] + bump, r[2] - bump + 0.1 * r[0]};
  });
}

std::vector<double> uniform_flux(const BedMesh& mesh, const Vector3& u) {
  std::vector<double> flux;
  for (const Vector3& area : mesh.face_area) flux.push_back(u[0] * area[0] + u[1] * area[1] + u[2] * area[2]);
  return flux;
}

std::vector<double> ones(const BedMesh& mesh) { return std::vector<double>(mesh.cells(), 1.0); }

/// Free of divergence to round-off and closed at walls: circulation of random values on the edges of the mesh; edges
/// whose ends are points of a wall carry none, those of front and back one value where these are periodic.
std::vector<double> random_solenoidal_flux(const StructuredMesh& structured, unsigned seed) {
  const BedMesh& mesh = structured.mesh;
  const auto [nx, ny, nz] = structured.cells;
  const bool periodic = mesh.periodic_depth > 0;
  const auto grid = [&, nx = nx, ny = ny](std::int64_t point) {
    return std::array<std::int64_t, 3>{point % (nx + 1), point / (nx + 1) % (ny + 1), point / ((nx + 1) * (ny + 1))};
  };
  std::mt19937_64 random(seed);
  std::uniform_real_distribution<double> value(-1, 1);
  std::map<std::array<std::int64_t, 6>, double> edges;
  const auto on_wall = [&, nx = nx, ny = ny, nz = nz](const std::array<std::int64_t, 3>& a,
                                                      const std::array<std::int64_t, 3>& b) {
    const auto both = [&](std::size_t axis, std::int64_t last) {
      return a[axis] == b[axis] && (a[axis] == 0 || a[axis] == last);
    };
    return both(0, nx) || both(2, nz) || (!periodic && both(1, ny));
  };
  const auto along = [&, ny = ny](std::int64_t from, std::int64_t to) {
    auto a = grid(from);
    auto b = grid(to);
    if (on_wall(a, b)) return 0.0;
    const double sign = a < b ? 1 : -1;
    if (b < a) std::swap(a, b);
    if (periodic && a[1] == ny && b[1] == ny) a[1] = b[1] = 0;
    const std::array<std::int64_t, 6> key{a[0], a[1], a[2], b[0], b[1], b[2]};
    const auto [found, fresh] = edges.try_emplace(key, 0.0);
    if (fresh) found->second = value(random);
    return sign * found->second;
  };
  std::vector<double> flux;
  for (const auto& ring : mesh.face_points) {
    double sum = 0;
    for (std::size_t i = 0; i < 4; ++i) sum += along(ring[i], ring[(i + 1) % 4]);
    flux.push_back(sum);
  }
  return flux;
}

double largest_divergence(const BedMesh& mesh, const std::vector<double>& flux) {
  double largest = 0;
  for (std::size_t cell = 0; cell < mesh.cells(); ++cell) {
    double sum = 0;
    for (const std::int64_t face : mesh.cell_faces[cell]) {
      sum += index(mesh.face_owner[index(face)]) == cell ? flux[index(face)] : -flux[index(face)];
    }
    largest = std::max(largest, std::abs(sum));
  }
  return largest;
}

TEST(Path, UniformFieldMovesAGridUniformlyOnTheSlotsTrapezoids) {
  const StructuredMesh structured = slot();
  const BedMesh& mesh = structured.mesh;
  const Vector3 u{0.011, 0, -0.03};
  const PathField field(mesh, uniform_flux(mesh, u), ones(mesh));
  const CellLocator locator(mesh);
  int moved = 0;
  for (double x = -0.9; x < 1; x += 0.13) {
    for (double y = -0.28; y < 0.3; y += 0.11) {
      for (double z = 3.05; z < 6; z += 0.17) {
        Point point = field.locate_in(locator.find({x, y, z}), {x, y, z});
        ASSERT_LT(distance(field.position(point), {x, y, z}), 1e-13);
        const double seconds = 80;  // about a dozen cells, over the bend in the wall
        bool inside = true;
        for (int step = 0; step < 8 && inside; ++step) inside = field.advance(point, seconds / 8) == End::time_up;
        if (!inside) continue;
        EXPECT_LT(distance(field.position(point), {x + u[0] * seconds, y, z + u[2] * seconds}), 1e-10);
        ++moved;
      }
    }
  }
  EXPECT_GT(moved, 1000);
}

TEST(Path, VelocityIsTheUniformOne) {
  const StructuredMesh structured = slot();
  const Vector3 u{0.011, 0, -0.03};
  const PathField field(structured.mesh, uniform_flux(structured.mesh, u),
                        std::vector<double>(structured.mesh.cells(), 0.5));
  for (std::int64_t cell = 0; cell < static_cast<std::int64_t>(structured.mesh.cells()); cell += 7) {
    const Vector3 v = field.velocity({cell, {0.3, 0.8, 0.1}});
    for (std::size_t i = 0; i < 3; ++i) EXPECT_NEAR(v[i], 2 * u[i], 1e-15);
  }
}

TEST(Path, NoPathCrossesAWall) {
  for (const StructuredMesh& structured : {slot(), bent_cube()}) {
    const BedMesh& mesh = structured.mesh;
    const std::vector<double> flux = random_solenoidal_flux(structured, 3);
    ASSERT_LT(largest_divergence(mesh, flux), 1e-14);
    const PathField field(mesh, flux, ones(mesh));
    const CellLocator locator(mesh);
    std::mt19937_64 random(7);
    std::uniform_real_distribution<double> unit(0, 1);
    std::int64_t crossed = 0;
    int lost = 0;
    const auto count = [](void* counter, std::int64_t, double) { ++*static_cast<std::int64_t*>(counter); };
    for (int start = 0; start < 50000; ++start) {
      const auto cell = static_cast<std::int64_t>(unit(random) * static_cast<double>(mesh.cells()));
      Point point{cell, {unit(random), unit(random), unit(random)}};
      const End end = field.advance(point, 20 * mesh.cell_volume[index(cell)], +count, &crossed);
      ASSERT_NE(end, End::left_through_outflow);
      for (const double r : point.reference) ASSERT_TRUE(r >= 0 && r <= 1);
      // Where the faces are planes the locator is an independent witness.
      if (mesh.periodic_depth > 0 && locator.find(field.position(point), point.cell) < 0) ++lost;
    }
    EXPECT_GT(crossed, 500000);
    EXPECT_EQ(lost, 0);
    EXPECT_EQ(field.fallbacks(), 0);
  }
}

TEST(Path, GoingBackReturnsToTheStart) {
  for (const StructuredMesh& structured : {slot(), bent_cube()}) {
    const BedMesh& mesh = structured.mesh;
    std::vector<double> flux = random_solenoidal_flux(structured, 11);
    const PathField there(mesh, flux, ones(mesh));
    for (double& value : flux) value = -value;
    const PathField back(mesh, flux, ones(mesh));
    std::mt19937_64 random(13);
    std::uniform_real_distribution<double> unit(0.05, 0.95);
    double sum = 0;
    int count = 0;
    for (int start = 0; start < 2000; ++start) {
      const auto cell = static_cast<std::int64_t>(unit(random) * static_cast<double>(mesh.cells()));
      Point point{cell, {unit(random), unit(random), unit(random)}};
      const Vector3 from = there.position(point);
      const double seconds = 3 * mesh.cell_volume[index(cell)];
      there.advance(point, seconds);
      back.advance(point, seconds);
      Vector3 to = back.position(point);
      if (mesh.periodic_depth > 0) to[1] -= mesh.periodic_depth * std::round((to[1] - from[1]) / mesh.periodic_depth);
      // Paths part exponentially at the field's stagnation points: round-off grows, and is small on nearly all.
      count += distance(from, to) < 1e-9 ? 1 : 0;
      sum += 1;
    }
    EXPECT_GT(count / sum, 0.99);
  }
}

TEST(Path, FollowsTheStreamFunctionOfASolidBodyRotation) {
  // Fluxes from the exact stream function at the grid's points: the path keeps its bilinear interpolation exactly, and
  // comes round after one period with an error that falls with the power 1.5 of the cell (mean over many starts).
  std::vector<double> misses;
  for (const std::int64_t cells : {16, 32, 64}) {
    const StructuredMesh structured = structured_mesh({cells, 1, cells}, 0.1, [](const Vector3& r) {
      return Vector3{2 * r[0] - 1, 0.1 * r[1], 2 * r[2] - 1};
    });
    const BedMesh& mesh = structured.mesh;
    const auto stream = [](const Vector3& at) { return -(at[0] * at[0] + at[2] * at[2]) / 2; };
    std::vector<double> flux;
    for (const Vector3& area : mesh.face_area) flux.push_back(0 * area[0]);
    for (std::size_t face = 0; face < mesh.faces(); ++face) {
      // u = (d stream/dz, -d stream/dx) = (-z, x): through a face the difference of its ends, times the depth.
      const Vector3& area = mesh.face_area[face];
      const Vector3& c = mesh.face_centre[face];
      const double half = 1.0 / static_cast<double>(cells);
      if (std::abs(area[0]) > 0) {
        flux[face] = std::copysign(0.1, area[0]) * (stream({c[0], 0, c[2] + half}) - stream({c[0], 0, c[2] - half}));
      } else if (std::abs(area[2]) > 0) {
        flux[face] = std::copysign(0.1, area[2]) * -(stream({c[0] + half, 0, c[2]}) - stream({c[0] - half, 0, c[2]}));
      }
    }
    const PathField field(mesh, flux, ones(mesh));
    const CellLocator locator(mesh);
    const auto interpolated = [&](const Point& point) {
      double value = 0;
      for (std::size_t c = 0; c < 8; ++c) {
        const auto weight = [&](std::size_t axis, bool upper) {
          return upper ? point.reference[axis] : 1 - point.reference[axis];
        };
        const bool upper_x = c == 1 || c == 2 || c == 5 || c == 6;
        const bool upper_y = c == 2 || c == 3 || c == 6 || c == 7;
        value += weight(0, upper_x) * weight(1, upper_y) * weight(2, c > 3) *
                 stream(mesh.points[index(mesh.cell_points[index(point.cell)][c])]);
      }
      return value;
    };
    double sum = 0;
    constexpr int starts = 200;
    for (int i = 0; i < starts; ++i) {
      const Vector3 start{0.3 + 0.5 * i / starts, 0.05, 0.12};
      Point point = field.locate_in(locator.find(start), start);
      const double value = interpolated(point);
      EXPECT_EQ(field.advance(point, 2 * std::numbers::pi), End::time_up);
      EXPECT_NEAR(interpolated(point), value, 1e-13);
      sum += std::pow(distance(field.position(point), start), 2);
    }
    misses.push_back(std::sqrt(sum / starts));
  }
  EXPECT_LT(misses[0], 0.1);
  EXPECT_LT(misses[1], misses[0] / 2.5);
  EXPECT_LT(misses[2], misses[1] / 2.5);
}

TEST(Path, AgreesWithSmallStepsThroughItsOwnVelocity) {
  const StructuredMesh structured = bent_cube();
  const BedMesh& mesh = structured.mesh;
  const PathField field(mesh, random_solenoidal_flux(structured, 17), std::vector<double>(mesh.cells(), 0.6));
  std::mt19937_64 random(19);
  std::uniform_real_distribution<double> unit(0.2, 0.8);
  int compared = 0;
  for (int start = 0; start < 60; ++start) {
    const auto cell = static_cast<std::int64_t>(unit(random) * static_cast<double>(mesh.cells()));
    const Point from{cell, {unit(random), unit(random), unit(random)}};
    Point exact = from;
    const double seconds = 0.05 * mesh.cell_volume[index(cell)];
    field.advance(exact, seconds);
    if (exact.cell != cell) continue;
    // Classical Runge-Kutta in space, within the cell, where the field is smooth.
    Vector3 x = field.position(from);
    constexpr int steps = 100;
    const double h = seconds / steps;
    const auto rate = [&](const Vector3& at) { return field.velocity(field.locate_in(cell, at)); };
    const auto shifted = [](const Vector3& a, double factor, const Vector3& b) {
      return Vector3{a[0] + factor * b[0], a[1] + factor * b[1], a[2] + factor * b[2]};
    };
    for (int step = 0; step < steps; ++step) {
      const Vector3 k1 = rate(x);
      const Vector3 k2 = rate(shifted(x, h / 2, k1));
      const Vector3 k3 = rate(shifted(x, h / 2, k2));
      const Vector3 k4 = rate(shifted(x, h, k3));
      for (std::size_t i = 0; i < 3; ++i) x[i] += h / 6 * (k1[i] + 2 * k2[i] + 2 * k3[i] + k4[i]);
    }
    EXPECT_LT(distance(field.position(exact), x), 1e-9);
    ++compared;
  }
  EXPECT_GT(compared, 30);
}

TEST(Path, SinksSlowAPathDownExponentially) {
  // A column whose downward flux falls in proportion to the height: z = z0 exp(-k t), exactly.
  const StructuredMesh structured = structured_mesh({1, 1, 10}, 0, [](const Vector3& r) {
    return Vector3{r[0], r[1], 2 * r[2]};
  });
  const BedMesh& mesh = structured.mesh;
  const double k = 0.7;
  std::vector<double> flux;
  for (std::size_t face = 0; face < mesh.faces(); ++face) {
    flux.push_back(-k * mesh.face_centre[face][2] * mesh.face_area[face][2]);
  }
  const PathField field(mesh, flux, ones(mesh));
  Point point = field.locate_in(9, {0.4, 0.6, 1.93});
  for (int step = 1; step <= 20; ++step) {
    EXPECT_EQ(field.advance(point, 0.5), End::time_up);
    EXPECT_NEAR(field.position(point)[2], 1.93 * std::exp(-k * 0.5 * step), 1e-12);
  }
  EXPECT_DOUBLE_EQ(field.position(point)[0], 0.4);
}

TEST(Path, StorageSlowsItDown) {
  const StructuredMesh structured = structured_mesh({4, 1, 4}, 0, [](const Vector3& r) { return r; });
  const BedMesh& mesh = structured.mesh;
  std::vector<double> storage = ones(mesh);
  for (std::size_t cell = 0; cell < 16; ++cell) storage[cell] = cell % 4 < 2 ? 0.5 : 0.25;
  const PathField field(mesh, uniform_flux(mesh, {0.1, 0, 0}), storage);
  Point point{structured.cell(0, 0, 1), {0, 0.5, 0.5}};
  EXPECT_EQ(field.advance(point, 3), End::time_up);  // 2.5 s to the middle at 0.2 m/s, then 0.5 s at 0.4 m/s
  EXPECT_NEAR(field.position(point)[0], 0.7, 1e-14);
  EXPECT_NEAR(field.crossing_time(structured.cell(0, 0, 1)), 0.25 / 0.2, 1e-12);
  EXPECT_NEAR(field.crossing_time(structured.cell(3, 0, 1)), 0.25 / 0.4, 1e-12);
}

TEST(Path, LeavesThroughAnOutflowAndStaysOnIt) {
  const StructuredMesh structured = structured_mesh({4, 1, 4}, 0, [](const Vector3& r) { return r; });
  const PathField field(structured.mesh, uniform_flux(structured.mesh, {0.1, 0, 0}), ones(structured.mesh));
  Point point{structured.cell(0, 0, 1), {0, 0.5, 0.5}};
  double stayed = 0;
  const auto add = [](void* sum, std::int64_t, double seconds) { *static_cast<double*>(sum) += seconds; };
  EXPECT_EQ(field.advance(point, 30, +add, &stayed), End::left_through_outflow);
  EXPECT_NEAR(stayed, 10, 1e-12);
  EXPECT_DOUBLE_EQ(field.position(point)[0], 1);
}

TEST(Path, ResidenceAddsUpToTheTime) {
  const StructuredMesh structured = slot();
  const BedMesh& mesh = structured.mesh;
  const PathField field(mesh, random_solenoidal_flux(structured, 23), ones(mesh));
  const auto add = [](void* sum, std::int64_t cell, double seconds) {
    EXPECT_GE(cell, 0);
    EXPECT_GT(seconds, 0);
    *static_cast<double*>(sum) += seconds;
  };
  std::mt19937_64 random(29);
  std::uniform_real_distribution<double> unit(0, 1);
  for (int start = 0; start < 1000; ++start) {
    const auto cell = static_cast<std::int64_t>(unit(random) * static_cast<double>(mesh.cells()));
    Point point{cell, {unit(random), unit(random), unit(random)}};
    double stayed = 0;
    const double seconds = unit(random);
    field.advance(point, seconds, +add, &stayed);
    EXPECT_NEAR(stayed, seconds, 1e-12);
  }
}

TEST(Path, WrapsAlongTheDepth) {
  const StructuredMesh structured = structured_mesh({2, 3, 2}, 0.6, [](const Vector3& r) {
    return Vector3{r[0], 0.6 * r[1] - 0.3, r[2]};
  });
  const PathField field(structured.mesh, uniform_flux(structured.mesh, {0, 0.1, 0}), ones(structured.mesh));
  Point point = field.locate_in(structured.cell(0, 1, 1), {0.3, 0.05, 0.8});
  EXPECT_EQ(field.advance(point, 17), End::time_up);
  EXPECT_NEAR(field.position(point)[1], 0.05 + 1.7 - 3 * 0.6, 1e-13);
  EXPECT_NEAR(field.position(field.locate_in(structured.cell(0, 1, 1), {0.3, 0.65, 0.8}))[1], 0.05, 1e-13);
}

TEST(Path, StandsWhereNothingFlows) {
  const StructuredMesh structured = structured_mesh({2, 2, 2}, 0, [](const Vector3& r) { return r; });
  const BedMesh& mesh = structured.mesh;
  const PathField field(mesh, std::vector<double>(mesh.faces(), 0.0), ones(mesh));
  Point point{3, {0.1, 0.2, 1}};
  double stayed = 0;
  const auto add = [](void* sum, std::int64_t, double seconds) { *static_cast<double*>(sum) += seconds; };
  EXPECT_EQ(field.advance(point, 5, +add, &stayed), End::stagnant);
  EXPECT_EQ(stayed, 5);
  EXPECT_EQ(point.cell, 3);
  EXPECT_EQ(field.crossing_time(3), std::numeric_limits<double>::infinity());
}

TEST(Path, RoundAnEdgeItGivesUpAndIsCounted) {
  // Four cells with a flow round their common edge; a point on the edge itself would go round for ever.
  const StructuredMesh structured = structured_mesh({2, 1, 2}, 0, [](const Vector3& r) { return r; });
  const BedMesh& mesh = structured.mesh;
  std::vector<double> flux(mesh.faces(), 0.0);
  const auto set = [&](std::int64_t cell, std::size_t side, double out) {
    const std::int64_t face = mesh.cell_faces[index(cell)][side];
    flux[index(face)] = mesh.face_owner[index(face)] == cell ? out : -out;
  };
  set(structured.cell(0, 0, 0), 1, 1);
  set(structured.cell(1, 0, 0), 5, 1);
  set(structured.cell(1, 0, 1), 0, 1);
  set(structured.cell(0, 0, 1), 4, 1);
  ASSERT_LT(largest_divergence(mesh, flux), 1e-15);
  const PathField field(mesh, flux, ones(mesh));
  Point point{structured.cell(0, 0, 0), {1, 0.5, 1}};
  EXPECT_EQ(field.advance(point, 5), End::stagnant);
  EXPECT_EQ(field.fallbacks(), 1);
  // Beside the edge it goes round and round.
  Point beside{structured.cell(0, 0, 0), {0.9, 0.5, 0.9}};
  EXPECT_EQ(field.advance(beside, 5), End::time_up);
  EXPECT_LT(std::hypot(field.position(beside)[0] - 0.5, field.position(beside)[2] - 0.5), 0.15);
}

TEST(Path, NearlyEqualFluxesAreNoSpecialCase) {
  // The two fluxes of a cell differ by less and less: the position goes over smoothly into that of equal ones.
  const StructuredMesh structured = structured_mesh({1, 1, 1}, 0, [](const Vector3& r) { return r; });
  const BedMesh& mesh = structured.mesh;
  for (double difference = 1; difference > 1e-18; difference /= 3) {
    std::vector<double> flux(mesh.faces(), 0.0);
    flux[index(mesh.cell_faces[0][0])] = -0.1;
    flux[index(mesh.cell_faces[0][1])] = 0.1 * (1 + difference);
    const PathField field(mesh, flux, ones(mesh));
    Point point{0, {0.2, 0.5, 0.5}};
    EXPECT_EQ(field.advance(point, 2), End::time_up);
    const double b = 0.1 * difference;
    const double wanted = b > 1e-12 ? (0.2 + 1 / difference) * std::exp(2 * b) - 1 / difference : 0.4;
    EXPECT_NEAR(point.reference[0], wanted, b > 1e-12 ? 1e-15 / difference + 1e-13 : 1e-11);
  }
}

TEST(Path, RefusesWhatDoesNotFit) {
  const StructuredMesh structured = structured_mesh({2, 1, 2}, 0, [](const Vector3& r) { return r; });
  const BedMesh& mesh = structured.mesh;
  const std::vector<double> flux(mesh.faces(), 0.0);
  std::vector<double> storage = ones(mesh);
  EXPECT_THROW(PathField(mesh, {}, storage), Failure);
  storage[1] = 0;
  EXPECT_THROW(PathField(mesh, flux, storage), Failure);
  BedMesh turned = mesh;
  std::swap(turned.cell_faces[1][0], turned.cell_faces[1][1]);
  EXPECT_THROW(PathField(turned, flux, ones(mesh)), Failure);
}

}  // namespace
}  // namespace cupola
