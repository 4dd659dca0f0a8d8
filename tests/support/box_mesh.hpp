#pragma once
#include <array>
#include <functional>

#include "physics/mesh/bed_mesh.hpp"

namespace cupola::testing {

/// A block of hexahedra between two corners as a BedMesh (structured_mesh.hpp): for tests of what works on plain
/// arrays.
struct BoxMesh {
  std::array<std::int64_t, 3> cells{4, 4, 4};
  Vector3 lower{0, 0, 0};
  Vector3 upper{1, 1, 1};
  bool periodic_y = false;
  /// Moves the points of the regular block; faces stay flat where it maps planes of the grid to planes.
  std::function<Vector3(const Vector3&)> deform = [](const Vector3& point) { return point; };

  [[nodiscard]] BedMesh make() const;
};

}  // namespace cupola::testing
