#include "tests/support/structured_mesh.hpp"

#include <cmath>

namespace cupola {
namespace {

using Triple = std::array<std::int64_t, 3>;

std::size_t index(std::int64_t i) { return static_cast<std::size_t>(i); }

Vector3 cross(const Vector3& a, const Vector3& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}

class Builder {
 public:
  Builder(const Triple& cells, double periodic_depth) : cells_(cells) {
    result.cells = cells;
    result.mesh.periodic_depth = periodic_depth;
    const std::size_t count = index(cells[0] * cells[1] * cells[2]);
    result.mesh.cell_points.resize(count);
    result.mesh.cell_faces.resize(count);
    result.mesh.cell_volume.assign(count, 0);
    result.mesh.cell_centre.assign(count, {});
  }

  void add_points(const std::function<Vector3(const Vector3&)>& place) {
    for (std::int64_t k = 0; k <= cells_[2]; ++k) {
      for (std::int64_t j = 0; j <= cells_[1]; ++j) {
        for (std::int64_t i = 0; i <= cells_[0]; ++i) {
          result.mesh.points.push_back(place({static_cast<double>(i) / static_cast<double>(cells_[0]),
                                              static_cast<double>(j) / static_cast<double>(cells_[1]),
                                              static_cast<double>(k) / static_cast<double>(cells_[2])}));
        }
      }
    }
    result.mesh.find_bounds();
    constexpr std::array<Triple, 8> corners{
        {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}, {0, 0, 1}, {1, 0, 1}, {1, 1, 1}, {0, 1, 1}}};
    each_cell([&](const Triple& at) {
      Vector3& centre = result.mesh.cell_centre[cell(at)];
      for (std::size_t c = 0; c < 8; ++c) {
        const std::int64_t number = point({at[0] + corners[c][0], at[1] + corners[c][1], at[2] + corners[c][2]});
        result.mesh.cell_points[cell(at)][c] = number;
        for (std::size_t i = 0; i < 3; ++i) centre[i] += result.mesh.points[index(number)][i] / 8;
      }
    });
  }

  void add_faces() {
    for (std::size_t axis = 0; axis < 3; ++axis) {
      each_cell([&](const Triple& at) {
        if (at[axis] + 1 < cells_[axis]) add_face(at, axis, true, true);
      });
    }
    result.mesh.internal_face_count = result.mesh.faces();
    constexpr std::array<std::array<const char*, 2>, 3> names{
        {{"left", "right"}, {"front", "back"}, {"bottom", "outlet"}}};
    for (std::size_t axis = 0; axis < 3; ++axis) {
      for (const bool upper : {false, true}) {
        const auto first = static_cast<std::int64_t>(result.mesh.faces());
        each_cell([&](const Triple& at) {
          if (at[axis] == (upper ? cells_[axis] - 1 : 0)) add_face(at, axis, upper, false);
        });
        const auto count = static_cast<std::int64_t>(result.mesh.faces()) - first;
        const bool periodic = axis == 1 && result.mesh.periodic_depth > 0;
        const auto kind = periodic               ? BedMesh::PatchKind::periodic
                          : (axis == 2 && upper) ? BedMesh::PatchKind::outlet
                                                 : BedMesh::PatchKind::wall;
        result.mesh.patches.push_back({names[axis][upper ? 1 : 0], kind, first, count});
      }
    }
    if (result.mesh.periodic_depth > 0) pair_up(result.mesh.patches[2], result.mesh.patches[3]);
  }

  StructuredMesh result;

 private:
  template <typename Visit>
  void each_cell(const Visit& visit) const {
    for (std::int64_t k = 0; k < cells_[2]; ++k) {
      for (std::int64_t j = 0; j < cells_[1]; ++j) {
        for (std::int64_t i = 0; i < cells_[0]; ++i) visit(Triple{i, j, k});
      }
    }
  }
  [[nodiscard]] std::size_t cell(const Triple& at) const { return index(result.cell(at[0], at[1], at[2])); }
  [[nodiscard]] std::int64_t point(const Triple& at) const {
    return (at[2] * (cells_[1] + 1) + at[1]) * (cells_[0] + 1) + at[0];
  }

  /// The face of a cell at the upper or lower end of an axis, owned by that cell, with its area looking out.
  void add_face(const Triple& at, std::size_t axis, bool upper, bool internal) {
    BedMesh& mesh = result.mesh;
    const std::size_t u = (axis + 1) % 3;
    const std::size_t v = (axis + 2) % 3;
    std::array<std::int64_t, 4> ring{};
    constexpr std::array<std::array<std::int64_t, 2>, 4> steps{{{0, 0}, {1, 0}, {1, 1}, {0, 1}}};
    for (std::size_t c = 0; c < 4; ++c) {
      Triple corner = at;
      corner[axis] += upper ? 1 : 0;
      corner[u] += steps[upper ? c : 3 - c][0];
      corner[v] += steps[upper ? c : 3 - c][1];
      ring[c] = point(corner);
    }
    const auto number = static_cast<std::int64_t>(mesh.faces());
    mesh.face_points.push_back(ring);
    mesh.face_owner.push_back(static_cast<std::int64_t>(cell(at)));
    mesh.face_partner.push_back(-1);
    mesh.cell_faces[cell(at)][2 * axis + (upper ? 1 : 0)] = number;
    std::int64_t neighbour = -1;
    if (internal) {
      Triple next = at;
      ++next[axis];
      neighbour = static_cast<std::int64_t>(cell(next));
      mesh.cell_faces[cell(next)][2 * axis] = number;
    }
    mesh.face_neighbour.push_back(neighbour);
    Vector3 centre{};
    for (const std::int64_t corner : ring) {
      for (std::size_t i = 0; i < 3; ++i) centre[i] += mesh.points[index(corner)][i] / 4;
    }
    const auto diagonal = [&](std::size_t from, std::size_t to) {
      Vector3 d{};
      for (std::size_t i = 0; i < 3; ++i) {
        d[i] = mesh.points[index(ring[to])][i] - mesh.points[index(ring[from])][i];
      }
      return d;
    };
    Vector3 area = cross(diagonal(0, 2), diagonal(1, 3));
    for (double& component : area) component /= 2;
    mesh.face_area.push_back(area);
    mesh.face_centre.push_back(centre);
    // Gauss: a cell's volume is a third of the sum of face centre times area.
    for (std::size_t i = 0; i < 3; ++i) {
      mesh.cell_volume[cell(at)] += (centre[i] - mesh.cell_centre[cell(at)][i]) * area[i] / 3;
      if (internal) {
        const auto next = index(neighbour);
        mesh.cell_volume[next] -= (centre[i] - mesh.cell_centre[next][i]) * area[i] / 3;
      }
    }
  }

  void pair_up(const BedMesh::Patch& one, const BedMesh::Patch& two) {
    BedMesh& mesh = result.mesh;
    for (std::int64_t k = 0; k < one.faces; ++k) {
      const std::size_t a = index(one.first_face + k);
      const std::size_t b = index(two.first_face + k);
      mesh.face_partner[a] = two.first_face + k;
      mesh.face_partner[b] = one.first_face + k;
      mesh.face_neighbour[a] = mesh.face_owner[b];
      mesh.face_neighbour[b] = mesh.face_owner[a];
    }
  }

  Triple cells_;
};

}  // namespace

StructuredMesh structured_mesh(const std::array<std::int64_t, 3>& cells, double periodic_depth,
                               const std::function<Vector3(const Vector3&)>& place) {
  Builder builder(cells, periodic_depth);
  builder.add_points(place);
  builder.add_faces();
  return builder.result;
}

}  // namespace cupola
