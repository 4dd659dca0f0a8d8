#include "physics/equations/face_geometry.hpp"

#include <cmath>

namespace cupola {
namespace {

Vector3 difference(const Vector3& a, const Vector3& b) { return {a[0] - b[0], a[1] - b[1], a[2] - b[2]}; }

/// `offset` without its part along the unit vector `normal`.
Vector3 in_plane(const Vector3& offset, const Vector3& normal) {
  const double along = dot(offset, normal);
  return {offset[0] - along * normal[0], offset[1] - along * normal[1], offset[2] - along * normal[2]};
}

/// Inverse of the symmetric matrix (xx, xy, xz, yy, yz, zz), in the same storage.
std::array<double, 6> inverse(const std::array<double, 6>& m) {
  const auto [xx, xy, xz, yy, yz, zz] = m;
  const double cofactor_xx = yy * zz - yz * yz;
  const double cofactor_xy = xz * yz - xy * zz;
  const double cofactor_xz = xy * yz - xz * yy;
  const double determinant = xx * cofactor_xx + xy * cofactor_xy + xz * cofactor_xz;
  return {cofactor_xx / determinant,         cofactor_xy / determinant,         cofactor_xz / determinant,
          (xx * zz - xz * xz) / determinant, (xy * xz - xx * yz) / determinant, (xx * yy - xy * xy) / determinant};
}

}  // namespace

FaceGeometry::FaceGeometry(const BedMesh& mesh) {
  const std::size_t faces = mesh.faces();
  area.resize(faces);
  normal.resize(faces);
  owner_distance.resize(faces);
  neighbour_distance.assign(faces, 0);
  owner_offset.resize(faces);
  neighbour_offset.assign(faces, Vector3{0, 0, 0});
  for (std::size_t face = 0; face < faces; ++face) {
    const Vector3& vector = mesh.face_area[face];
    area[face] = std::sqrt(dot(vector, vector));
    normal[face] = {vector[0] / area[face], vector[1] / area[face], vector[2] / area[face]};
    const Vector3 from_owner = difference(mesh.face_centre[face], mesh.cell_centre[mesh.face_owner[face]]);
    owner_distance[face] = dot(from_owner, normal[face]);
    owner_offset[face] = in_plane(from_owner, normal[face]);
    const auto neighbour = mesh.face_neighbour[face];
    if (neighbour < 0) continue;
    // Across periodic sides the neighbour is seen from the partner face.
    const auto partner = mesh.face_partner[face];
    const Vector3& seen_from = mesh.face_centre[partner >= 0 ? static_cast<std::size_t>(partner) : face];
    const Vector3 from_neighbour = difference(seen_from, mesh.cell_centre[neighbour]);
    neighbour_distance[face] = -dot(from_neighbour, normal[face]);
    neighbour_offset[face] = in_plane(from_neighbour, normal[face]);
  }

  inverse_.resize(mesh.cells());
  for (std::size_t cell = 0; cell < mesh.cells(); ++cell) {
    std::array<double, 6> sum{};
    for (const auto face : mesh.cell_faces[cell]) {
      const Vector3& n = normal[face];
      const double a = area[face];
      sum[0] += a * n[0] * n[0];
      sum[1] += a * n[0] * n[1];
      sum[2] += a * n[0] * n[2];
      sum[3] += a * n[1] * n[1];
      sum[4] += a * n[1] * n[2];
      sum[5] += a * n[2] * n[2];
    }
    inverse_[cell] = inverse(sum);
  }
}

std::vector<Vector3> FaceGeometry::cell_vectors(const BedMesh& mesh, const std::vector<double>& face_flux) const {
  std::vector<Vector3> result(mesh.cells());
  for (std::size_t cell = 0; cell < mesh.cells(); ++cell) {
    Vector3 sum{0, 0, 0};
    // The sign of a face's flux and of its normal cancel, whoever owns it.
    for (const auto face : mesh.cell_faces[cell]) {
      for (std::size_t axis = 0; axis < 3; ++axis) sum[axis] += normal[face][axis] * face_flux[face];
    }
    const auto& [xx, xy, xz, yy, yz, zz] = inverse_[cell];
    result[cell] = {xx * sum[0] + xy * sum[1] + xz * sum[2], xy * sum[0] + yy * sum[1] + yz * sum[2],
                    xz * sum[0] + yz * sum[1] + zz * sum[2]};
  }
  return result;
}

std::vector<double> FaceGeometry::outflow(const BedMesh& mesh, const std::vector<double>& face_flux) {
  std::vector<double> result(mesh.cells(), 0);
  for (std::size_t face = 0; face < mesh.faces(); ++face) {
    result[mesh.face_owner[face]] += face_flux[face];
    // A periodic face's neighbour has a face of its own.
    if (face < mesh.internal_faces()) result[mesh.face_neighbour[face]] -= face_flux[face];
  }
  return result;
}

std::vector<Vector3> FaceGeometry::surface_gradient(const BedMesh& mesh, const std::vector<double>& face_value) {
  std::vector<Vector3> gradient(mesh.cells(), Vector3{0, 0, 0});
  for (std::size_t face = 0; face < mesh.faces(); ++face) {
    const auto owner = mesh.face_owner[face];
    const auto neighbour = mesh.face_neighbour[face];
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const double part = face_value[face] * mesh.face_area[face][axis];
      gradient[owner][axis] += part / mesh.cell_volume[owner];
      if (face < mesh.internal_faces()) gradient[neighbour][axis] -= part / mesh.cell_volume[neighbour];
    }
  }
  return gradient;
}

}  // namespace cupola
