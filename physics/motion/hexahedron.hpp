#pragma once
#include <array>

#include "physics/mesh/bed_mesh.hpp"

namespace cupola {

/// The trilinear map from reference coordinates in [0,1]^3 to a hexahedron with the corners in VTK's order.
class Hexahedron {
 public:
  Hexahedron(const BedMesh& mesh, std::size_t cell);

  [[nodiscard]] Vector3 position(const Vector3& reference) const;
  /// d position[i] / d reference[j] as [i][j].
  [[nodiscard]] std::array<Vector3, 3> jacobian(const Vector3& reference) const;
  /// Its determinant, m3: positive in a sound cell.
  [[nodiscard]] double determinant(const Vector3& reference) const;
  /// Reference coordinates of a position by Newton's method, clamped to [0,1]^3.
  [[nodiscard]] Vector3 reference(const Vector3& position) const;

 private:
  std::array<Vector3, 8> coefficient_{};  ///< of 1, xi, eta, zeta, xi eta, eta zeta, zeta xi, xi eta zeta
};

}  // namespace cupola
