#include <gtest/gtest.h>

#include <cstdio>
#include <functional>
#include <numbers>
#include <random>

#include "physics/mesh/cell_locator.hpp"
#include "stage_tracer/motion.hpp"
#include "tests/support/furnaces.hpp"
#include "tests/support/structured_mesh.hpp"

namespace cupola {
namespace {

using Stream = std::function<double(double x, double z)>;

/// A square of 2 m by 2 m in x and z and a plane flow on it, given by its stream function s: u = (ds/dz, 0, -ds/dx).
class PlaneFlow {
 public:
  PlaneFlow(std::int64_t cells, const Stream& stream)
      : structured_(structured_mesh({cells, 1, cells}, 0.1,
                                    [](const Vector3& r) {
                                      return Vector3{2 * r[0] - 1, 0.1 * r[1], 2 * r[2] - 1};
                                    })),
        flux_(structured_.mesh.faces(), 0.0),
        campaign_(furnaces::shaft()) {
    const BedMesh& mesh = structured_.mesh;
    const double half = 1.0 / static_cast<double>(cells);
    for (std::size_t face = 0; face < mesh.faces(); ++face) {
      const Vector3& area = mesh.face_area[face];
      const Vector3& c = mesh.face_centre[face];
      if (std::abs(area[0]) > 0) {
        flux_[face] = std::copysign(0.1, area[0]) * (stream(c[0], c[2] + half) - stream(c[0], c[2] - half));
      } else if (std::abs(area[2]) > 0) {
        flux_[face] = std::copysign(0.1, area[2]) * (stream(c[0] - half, c[2]) - stream(c[0] + half, c[2]));
      }
    }
    campaign_.heat.reset();
    for (Species& species : campaign_.species) species.none_below = -10;
  }

  /// Where tracers that begin at `points` are after `seconds`, moved by the stage's own Motion in `steps` steps.
  [[nodiscard]] std::vector<Vector3> moved(const std::vector<Vector3>& points, double seconds, int steps) const {
    const BedMesh& mesh = structured_.mesh;
    const PathField paths(mesh, flux_, std::vector<double>(mesh.cells(), 1.0));
    const CellLocator locator(mesh);
    GranularField field;
    field.bed.assign(mesh.cells(), true);
    field.stagnant.assign(mesh.cells(), false);
    field.removal_rate.assign(mesh.cells(), 0.0);
    Tracers tracers;
    for (const Vector3& point : points) {
      tracers.add(static_cast<std::int64_t>(tracers.size()), 0, paths.locate_in(locator.find(point), point), 1e-6, 1);
    }
    const Motion motion(campaign_, field, paths);
    Tally tally;
    for (int k = 0; k < steps; ++k) {
      const auto moved = motion.advance(tracers, k * seconds / steps, (k + 1) * seconds / steps, {}, 1, tally);
      remove_leaving(tracers, moved.leaving, campaign_, tally);
    }
    EXPECT_EQ(tracers.size(), points.size()) << "tracers were lost";
    std::vector<Vector3> result;
    for (const PathField::Point& point : tracers.point) result.push_back(paths.position(point));
    return result;
  }

 private:
  StructuredMesh structured_;
  std::vector<double> flux_;
  Campaign campaign_;
};

std::vector<Vector3> blob(double x, double z, double radius, int count) {
  std::mt19937_64 engine(11);
  const auto uniform = [&] { return static_cast<double>(engine() >> 11) * 0x1p-53; };
  std::vector<Vector3> points;
  for (int i = 0; i < count; ++i) {
    const double r = radius * std::sqrt(uniform());
    const double angle = 2 * std::numbers::pi * uniform();
    points.push_back({x + r * std::cos(angle), 0.05, z + r * std::sin(angle)});
  }
  return points;
}

struct Errors {
  double tracers = 0;   ///< rms distance of the tracers from where they belong, m
  double centroid = 0;  ///< of the blob's centroid, m
};

Errors errors(const std::vector<Vector3>& found, const std::vector<Vector3>& exact) {
  Errors result;
  Vector3 shift{};
  const auto count = static_cast<double>(found.size());
  for (std::size_t i = 0; i < found.size(); ++i) {
    for (const std::size_t k : {0u, 2u}) {
      const double miss = found[i][k] - exact[i][k];
      result.tracers += miss * miss / count;
      shift[k] += miss / count;
    }
  }
  result.tracers = std::sqrt(result.tracers);
  result.centroid = std::hypot(shift[0], shift[2]);
  return result;
}

/// Errors on 16, 32, 64 and 128 cells a side; prints and returns them.
std::vector<Errors> refined(const char* what, const Stream& stream, const std::vector<Vector3>& points, double seconds,
                            const std::vector<Vector3>& exact) {
  std::vector<Errors> result;
  for (const std::int64_t cells : {16, 32, 64, 128}) {
    result.push_back(errors(PlaneFlow(cells, stream).moved(points, seconds, 10), exact));
    std::printf("%s, %3d cells a side: tracers %.3g m, centroid %.3g m", what, static_cast<int>(cells),
                result.back().tracers, result.back().centroid);
    if (result.size() > 1) {
      const Errors& before = result[result.size() - 2];
      std::printf("; orders %.2f, %.2f", std::log2(before.tracers / result.back().tracers),
                  std::log2(before.centroid / result.back().centroid));
    }
    std::printf("\n");
  }
  return result;
}

/// Order over the whole refinement.
double order(double coarsest, double finest) { return std::log2(coarsest / finest) / 3; }

TEST(Motion, BlobInSolidBodyRotationComesRound) {
  const auto points = blob(0.4, 0.1, 0.2, 2000);
  const auto found = refined(
      "rotation", [](double x, double z) { return -(x * x + z * z) / 2; }, points, 2 * std::numbers::pi, points);
  EXPECT_GT(order(found.front().tracers, found.back().tracers), 1.3);
  EXPECT_GT(order(found.front().centroid, found.back().centroid), 1.5);
}

TEST(Motion, BlobInShear) {
  const auto points = blob(-0.2, 0.1, 0.3, 2000);
  const double seconds = 1;
  auto exact = points;
  for (Vector3& point : exact) point[0] += point[2] * seconds;
  const auto found = refined(
      "shear", [](double, double z) { return z * z / 2; }, points, seconds, exact);
  // Inside a cell the speed does not vary across the flow: first order for a tracer, second for a cloud of them.
  EXPECT_GT(order(found.front().tracers, found.back().tracers), 0.95);
  EXPECT_GT(order(found.front().centroid, found.back().centroid), 1.5);
}

TEST(Motion, PathsDoNotDependOnTheTimeStep) {
  const auto points = blob(0.4, 0.1, 0.2, 500);
  const PlaneFlow flow(32, [](double x, double z) { return -(x * x + z * z) / 2; });
  const auto once = flow.moved(points, 3, 1);
  EXPECT_LT(errors(flow.moved(points, 3, 100), once).tracers, 1e-10);
}

}  // namespace
}  // namespace cupola
