#pragma once
#include <array>
#include <functional>

#include "physics/mesh/bed_mesh.hpp"

namespace cupola {

/// A BedMesh of nx x ny x nz cells made in memory, for tests of what moves on it: the unit cube's grid of points
/// carried to where `place` says.  The ends along x are the patches `left`, `right`, along y `front`, `back`, along z
/// `bottom`, `outlet`; front and back are periodic pairs where `periodic_depth` is positive.
struct StructuredMesh {
  std::array<std::int64_t, 3> cells{};
  BedMesh mesh;

  [[nodiscard]] std::int64_t cell(std::int64_t i, std::int64_t j, std::int64_t k) const {
    return (k * cells[1] + j) * cells[0] + i;
  }
};

StructuredMesh structured_mesh(const std::array<std::int64_t, 3>& cells, double periodic_depth,
                               const std::function<Vector3(const Vector3&)>& place);

}  // namespace cupola
