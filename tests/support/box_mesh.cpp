#include "tests/support/box_mesh.hpp"

#include <algorithm>
#include <vector>

namespace cupola::testing {
namespace {

Vector3 operator+(const Vector3& a, const Vector3& b) { return {a[0] + b[0], a[1] + b[1], a[2] + b[2]}; }
Vector3 operator-(const Vector3& a, const Vector3& b) { return {a[0] - b[0], a[1] - b[1], a[2] - b[2]}; }
Vector3 operator*(double s, const Vector3& a) { return {s * a[0], s * a[1], s * a[2]}; }
double dot(const Vector3& a, const Vector3& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }
Vector3 cross(const Vector3& a, const Vector3& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}

/// Corners of a reference cube's faces xi-, xi+, eta-, eta+, zeta-, zeta+, in order so that their normal points
/// outwards.
constexpr std::array<std::array<int, 4>, 6> face_corners{
    {{0, 4, 7, 3}, {1, 2, 6, 5}, {0, 1, 5, 4}, {3, 7, 6, 2}, {0, 3, 2, 1}, {4, 5, 6, 7}}};

struct Side {
  std::int64_t cell = 0;
  int side = 0;
};

}  // namespace

BedMesh BoxMesh::make() const {
  BedMesh mesh;
  mesh.hash = "box";
  const auto [nx, ny, nz] = cells;
  for (std::int64_t k = 0; k <= nz; ++k) {
    for (std::int64_t j = 0; j <= ny; ++j) {
      for (std::int64_t i = 0; i <= nx; ++i) {
        const Vector3 share{static_cast<double>(i) / static_cast<double>(nx),
                            static_cast<double>(j) / static_cast<double>(ny),
                            static_cast<double>(k) / static_cast<double>(nz)};
        Vector3 point{};
        for (std::size_t axis = 0; axis < 3; ++axis)
          point[axis] = lower[axis] + share[axis] * (upper[axis] - lower[axis]);
        mesh.points.push_back(deform(point));
      }
    }
  }
  const auto point_number = [&](std::int64_t i, std::int64_t j, std::int64_t k) {
    return (k * (ny + 1) + j) * (nx + 1) + i;
  };
  const auto cell_number = [&](std::int64_t i, std::int64_t j, std::int64_t k) { return (k * ny + j) * nx + i; };
  for (std::int64_t k = 0; k < nz; ++k) {
    for (std::int64_t j = 0; j < ny; ++j) {
      for (std::int64_t i = 0; i < nx; ++i) {
        mesh.cell_points.push_back({point_number(i, j, k), point_number(i + 1, j, k), point_number(i + 1, j + 1, k),
                                    point_number(i, j + 1, k), point_number(i, j, k + 1), point_number(i + 1, j, k + 1),
                                    point_number(i + 1, j + 1, k + 1), point_number(i, j + 1, k + 1)});
      }
    }
  }
  mesh.cell_faces.resize(mesh.cell_points.size());
  mesh.cell_volume.assign(mesh.cell_points.size(), 0);
  mesh.cell_centre.resize(mesh.cell_points.size());

  const auto add_face = [&](std::int64_t owner, int side, std::int64_t neighbour) {
    const auto face = static_cast<std::int64_t>(mesh.face_owner.size());
    std::array<std::int64_t, 4> corners{};
    for (std::size_t corner = 0; corner < 4; ++corner)
      corners[corner] = mesh.cell_points[owner][face_corners[side][corner]];
    const Vector3 &a = mesh.points[corners[0]], &b = mesh.points[corners[1]], &c = mesh.points[corners[2]],
                  &d = mesh.points[corners[3]];
    const Vector3 first = 0.5 * cross(b - a, c - a), second = 0.5 * cross(c - a, d - a);
    const Vector3 area = first + second;
    const double first_share = dot(first, area) / dot(area, area);
    mesh.face_points.push_back(corners);
    mesh.face_owner.push_back(owner);
    mesh.face_neighbour.push_back(neighbour);
    mesh.face_partner.push_back(-1);
    mesh.face_area.push_back(area);
    mesh.face_centre.push_back((first_share / 3) * (a + b + c) + ((1 - first_share) / 3) * (a + c + d));
    mesh.cell_faces[owner][side] = face;
    return face;
  };

  std::array<std::vector<Side>, 6> boundary;
  for (std::int64_t k = 0; k < nz; ++k) {
    for (std::int64_t j = 0; j < ny; ++j) {
      for (std::int64_t i = 0; i < nx; ++i) {
        const auto cell = cell_number(i, j, k);
        const std::array<std::int64_t, 3> next{i + 1 < nx ? cell_number(i + 1, j, k) : -1,
                                               j + 1 < ny ? cell_number(i, j + 1, k) : -1,
                                               k + 1 < nz ? cell_number(i, j, k + 1) : -1};
        for (int axis = 0; axis < 3; ++axis) {
          if (next[axis] < 0) {
            boundary[2 * axis + 1].push_back({cell, 2 * axis + 1});
          } else {
            mesh.cell_faces[next[axis]][2 * axis] = add_face(cell, 2 * axis + 1, next[axis]);
          }
        }
        if (i == 0) boundary[0].push_back({cell, 0});
        if (j == 0) boundary[2].push_back({cell, 2});
        if (k == 0) boundary[4].push_back({cell, 4});
      }
    }
  }
  mesh.internal_face_count = mesh.faces();
  const auto add_patch = [&](const std::string& name, BedMesh::PatchKind kind, const std::vector<int>& sides) {
    BedMesh::Patch patch{name, kind, static_cast<std::int64_t>(mesh.faces()), 0};
    for (const int side : sides) {
      for (const auto& [cell, number] : boundary[side]) add_face(cell, number, -1);
    }
    patch.faces = static_cast<std::int64_t>(mesh.faces()) - patch.first_face;
    mesh.patches.push_back(patch);
    return patch;
  };
  add_patch("wall", BedMesh::PatchKind::wall, periodic_y ? std::vector<int>{0, 1} : std::vector<int>{0, 1, 2, 3});
  if (periodic_y) {
    const auto front = add_patch("front", BedMesh::PatchKind::periodic, {2});
    const auto back = add_patch("back", BedMesh::PatchKind::periodic, {3});
    // Both sides were visited in the same order.
    for (std::int64_t face = 0; face < front.faces; ++face) {
      const auto one = front.first_face + face, other = back.first_face + face;
      mesh.face_partner[one] = other;
      mesh.face_partner[other] = one;
      mesh.face_neighbour[one] = mesh.face_owner[other];
      mesh.face_neighbour[other] = mesh.face_owner[one];
    }
    mesh.periodic_depth = upper[1] - lower[1];
  }
  add_patch("bottom", BedMesh::PatchKind::wall, {4});
  add_patch("outlet", BedMesh::PatchKind::outlet, {5});

  for (std::size_t cell = 0; cell < mesh.cells(); ++cell) {
    Vector3 middle{0, 0, 0};
    for (const auto point : mesh.cell_points[cell]) middle = middle + 0.125 * mesh.points[point];
    Vector3 moment{0, 0, 0};
    for (const auto face : mesh.cell_faces[cell]) {
      const double sign = mesh.face_owner[face] == static_cast<std::int64_t>(cell) ? 1 : -1;
      const double pyramid = sign * dot(mesh.face_area[face], mesh.face_centre[face] - middle) / 3;
      mesh.cell_volume[cell] += pyramid;
      moment = moment + pyramid * (0.75 * mesh.face_centre[face] + 0.25 * middle);
    }
    mesh.cell_centre[cell] = (1 / mesh.cell_volume[cell]) * moment;
  }
  mesh.lower = mesh.upper = mesh.points.front();
  for (const auto& point : mesh.points) {
    for (std::size_t axis = 0; axis < 3; ++axis) {
      mesh.lower[axis] = std::min(mesh.lower[axis], point[axis]);
      mesh.upper[axis] = std::max(mesh.upper[axis], point[axis]);
    }
  }
  return mesh;
}

}  // namespace cupola::testing
