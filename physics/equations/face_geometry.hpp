#pragma once
#include <array>
#include <vector>

#include "physics/mesh/bed_mesh.hpp"

namespace cupola {

/// What two-point formulas need of the faces of a BedMesh, from the owner to the neighbour (across periodic sides too).
struct FaceGeometry {
  explicit FaceGeometry(const BedMesh& mesh);

  std::vector<double> area;            ///< m2
  std::vector<Vector3> normal;         ///< unit, out of the owner
  std::vector<double> owner_distance;  ///< m, along the normal from the owner's centre to the face
  std::vector<double>
      neighbour_distance;  ///< m, along the normal from the face to the neighbour's centre; 0 where there is none
  std::vector<Vector3> owner_offset;  ///< m, in the face's plane: face centre - owner's centre, without the normal part
  std::vector<Vector3>
      neighbour_offset;  ///< m, the same of the neighbour (of the periodic image); 0 where there is none

  /// Cell vectors from fluxes through faces (out of the owner): the least-squares fit of v . S to the fluxes, face by
  /// face weighted with 1/area; exact for a uniform field.
  [[nodiscard]] std::vector<Vector3> cell_vectors(const BedMesh& mesh, const std::vector<double>& face_flux) const;
  /// Sum of the fluxes out of each cell.
  static std::vector<double> outflow(const BedMesh& mesh, const std::vector<double>& face_flux);
  /// Gradient of a quantity known at the faces: its surface integral over the cell's volume.
  static std::vector<Vector3> surface_gradient(const BedMesh& mesh, const std::vector<double>& face_value);

 private:
  std::vector<std::array<double, 6>> inverse_;  ///< of sum S S/|S| a cell, 1/m2: xx, xy, xz, yy, yz, zz
};

inline double dot(const Vector3& a, const Vector3& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }

}  // namespace cupola
