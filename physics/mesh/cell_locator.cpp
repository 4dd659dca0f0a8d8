#include "physics/mesh/cell_locator.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

namespace cupola {
namespace {

/// A point counts as inside a cell up to this share of the cell's size outside its faces, so that none falls between
/// cells.
constexpr double slack = 1e-9;

double squared_distance(const Vector3& a, const Vector3& b) {
  double sum = 0;
  for (std::size_t i = 0; i < 3; ++i) sum += (a[i] - b[i]) * (a[i] - b[i]);
  return sum;
}

/// Outward unit normal of a cell's face, and its distance from the origin less the slack.
struct Plane {
  Vector3 normal{};
  double offset = 0;
};

struct Box {
  Vector3 lower{};
  Vector3 upper{};
};

Box box_of(const BedMesh& mesh, std::size_t cell) {
  const auto& corners = mesh.cell_points[cell];
  Box box{mesh.points[static_cast<std::size_t>(corners[0])], mesh.points[static_cast<std::size_t>(corners[0])]};
  for (const std::int64_t corner : corners) {
    const Vector3& point = mesh.points[static_cast<std::size_t>(corner)];
    for (std::size_t i = 0; i < 3; ++i) {
      box.lower[i] = std::min(box.lower[i], point[i]);
      box.upper[i] = std::max(box.upper[i], point[i]);
    }
  }
  return box;
}

}  // namespace

/// A uniform grid of bins over the bounding box; each lists the cells whose boxes touch it.
struct CellLocator::State {
  explicit State(const BedMesh& bed_mesh) : mesh(bed_mesh) {
    make_planes();
    fill_bins();
  }

  void make_planes() {
    planes.resize(mesh.cells());
    for (std::size_t cell = 0; cell < mesh.cells(); ++cell) {
      const double size = std::cbrt(mesh.cell_volume[cell]);
      for (std::size_t side = 0; side < 6; ++side) {
        const auto face = static_cast<std::size_t>(mesh.cell_faces[cell][side]);
        const double sign = mesh.face_owner[face] == static_cast<std::int64_t>(cell) ? 1 : -1;
        const Vector3& area = mesh.face_area[face];
        const double length = std::hypot(area[0], area[1], area[2]);
        Plane& plane = planes[cell][side];
        plane.offset = slack * size;
        for (std::size_t i = 0; i < 3; ++i) {
          plane.normal[i] = sign * area[i] / length;
          plane.offset += plane.normal[i] * mesh.face_centre[face][i];
        }
      }
    }
  }

  void fill_bins() {
    std::vector<Box> boxes(mesh.cells());
    Vector3 mean_extent{};
    for (std::size_t cell = 0; cell < mesh.cells(); ++cell) {
      boxes[cell] = box_of(mesh, cell);
      for (std::size_t i = 0; i < 3; ++i) {
        mean_extent[i] += (boxes[cell].upper[i] - boxes[cell].lower[i]) / static_cast<double>(mesh.cells());
      }
    }
    for (std::size_t i = 0; i < 3; ++i) {
      const double extent = mesh.upper[i] - mesh.lower[i];
      bins[i] = std::max<std::int64_t>(1, std::llround(extent / mean_extent[i]));
      bin_size[i] = extent / static_cast<double>(bins[i]);
    }
    const auto each_bin_of = [&](std::size_t cell, const auto& visit) {
      std::array<std::int64_t, 3> first{};
      std::array<std::int64_t, 3> last{};
      for (std::size_t i = 0; i < 3; ++i) {
        const double margin = 1e-6 * bin_size[i];
        first[i] = bin_along(i, boxes[cell].lower[i] - margin);
        last[i] = bin_along(i, boxes[cell].upper[i] + margin);
      }
      for (std::int64_t k = first[2]; k <= last[2]; ++k) {
        for (std::int64_t j = first[1]; j <= last[1]; ++j) {
          for (std::int64_t i = first[0]; i <= last[0]; ++i) visit(bin_number(i, j, k));
        }
      }
    };
    begin.assign(static_cast<std::size_t>(bins[0] * bins[1] * bins[2]) + 1, 0);
    for (std::size_t cell = 0; cell < mesh.cells(); ++cell) {
      each_bin_of(cell, [&](std::size_t bin) { ++begin[bin + 1]; });
    }
    for (std::size_t bin = 1; bin < begin.size(); ++bin) begin[bin] += begin[bin - 1];
    members.resize(begin.back());
    std::vector<std::size_t> next(begin.begin(), begin.end() - 1);
    for (std::size_t cell = 0; cell < mesh.cells(); ++cell) {
      each_bin_of(cell, [&](std::size_t bin) { members[next[bin]++] = static_cast<std::int64_t>(cell); });
    }
  }

  [[nodiscard]] std::int64_t bin_along(std::size_t axis, double coordinate) const {
    const double position = std::floor((coordinate - mesh.lower[axis]) / bin_size[axis]);
    return static_cast<std::int64_t>(std::clamp(position, 0.0, static_cast<double>(bins[axis] - 1)));
  }

  [[nodiscard]] std::size_t bin_number(std::int64_t i, std::int64_t j, std::int64_t k) const {
    return static_cast<std::size_t>((k * bins[1] + j) * bins[0] + i);
  }

  [[nodiscard]] bool holds(std::int64_t cell, const Vector3& point) const {
    const auto& sides = planes[static_cast<std::size_t>(cell)];
    return std::all_of(sides.begin(), sides.end(), [&](const Plane& plane) {
      return plane.normal[0] * point[0] + plane.normal[1] * point[1] + plane.normal[2] * point[2] <= plane.offset;
    });
  }

  /// From cell to cell, each time across the face the point lies farthest outside of; -1 where that does not lead there
  /// in a few steps.
  [[nodiscard]] std::int64_t walk(std::int64_t cell, const Vector3& point) const {
    constexpr int most_steps = 4;
    for (int step = 0; step < most_steps && cell >= 0; ++step) {
      const auto& sides = planes[static_cast<std::size_t>(cell)];
      std::size_t worst = sides.size();
      double farthest = 0;
      for (std::size_t side = 0; side < sides.size(); ++side) {
        const auto& [normal, offset] = sides[side];
        const double beyond = normal[0] * point[0] + normal[1] * point[1] + normal[2] * point[2] - offset;
        if (beyond > farthest) {
          farthest = beyond;
          worst = side;
        }
      }
      if (worst == sides.size()) return cell;
      cell = mesh.across(cell, mesh.cell_faces[static_cast<std::size_t>(cell)][worst]);
    }
    return -1;
  }

  [[nodiscard]] Vector3 wrapped(const Vector3& point) const {
    Vector3 inside = point;
    if (mesh.periodic_depth > 0 && (point[1] < mesh.lower[1] || point[1] > mesh.upper[1])) {
      inside[1] -= mesh.periodic_depth * std::floor((point[1] - mesh.lower[1]) / mesh.periodic_depth);
    }
    return inside;
  }

  [[nodiscard]] bool far_outside(const Vector3& point) const {
    for (std::size_t i = 0; i < 3; ++i) {
      const double margin = slack * bin_size[i];
      // Written so that a coordinate that is not a number counts as outside.
      if (!(point[i] >= mesh.lower[i] - margin && point[i] <= mesh.upper[i] + margin)) return true;
    }
    return false;
  }

  const BedMesh& mesh;
  std::vector<std::array<Plane, 6>> planes;
  std::array<std::int64_t, 3> bins{};
  Vector3 bin_size{};
  std::vector<std::size_t> begin;     ///< of each bin's members
  std::vector<std::int64_t> members;  ///< cells
};

CellLocator::CellLocator(const BedMesh& mesh) : state_(std::make_unique<State>(mesh)) {}
CellLocator::~CellLocator() = default;
CellLocator::CellLocator(CellLocator&&) noexcept = default;
CellLocator& CellLocator::operator=(CellLocator&&) noexcept = default;

std::int64_t CellLocator::find(const Vector3& point, std::int64_t guess) const {
  const State& state = *state_;
  const Vector3 inside = state.wrapped(point);
  if (state.far_outside(inside)) return -1;
  if (guess >= 0) {
    const std::int64_t cell = state.walk(guess, inside);
    if (cell >= 0) return cell;
  }
  const std::size_t bin =
      state.bin_number(state.bin_along(0, inside[0]), state.bin_along(1, inside[1]), state.bin_along(2, inside[2]));
  for (std::size_t i = state.begin[bin]; i < state.begin[bin + 1]; ++i) {
    if (state.holds(state.members[i], inside)) return state.members[i];
  }
  return -1;
}

std::int64_t CellLocator::nearest(const Vector3& point) const {
  const State& state = *state_;
  const Vector3 inside = state.wrapped(point);
  std::array<std::int64_t, 3> centre{};
  for (std::size_t i = 0; i < 3; ++i) {
    if (!(inside[i] > state.mesh.lower[i] - 2 * state.bin_size[i] &&
          inside[i] < state.mesh.upper[i] + 2 * state.bin_size[i])) {
      return -1;
    }
    centre[i] = state.bin_along(i, inside[i]);
  }
  std::int64_t best = -1;
  double best_distance = std::numeric_limits<double>::max();
  const auto look_into = [&](std::size_t bin) {
    for (std::size_t m = state.begin[bin]; m < state.begin[bin + 1]; ++m) {
      const std::int64_t cell = state.members[m];
      const double distance = squared_distance(inside, state.mesh.cell_centre[static_cast<std::size_t>(cell)]);
      if (distance < best_distance) {
        best_distance = distance;
        best = cell;
      }
    }
  };
  const auto each = [](std::int64_t middle, std::int64_t count, const auto& visit) {
    for (std::int64_t i = std::max<std::int64_t>(0, middle - 1); i <= std::min(count - 1, middle + 1); ++i) visit(i);
  };
  each(centre[2], state.bins[2], [&](std::int64_t k) {
    each(centre[1], state.bins[1], [&](std::int64_t j) {
      each(centre[0], state.bins[0], [&](std::int64_t i) { look_into(state.bin_number(i, j, k)); });
    });
  });
  return best;
}

}  // namespace cupola
