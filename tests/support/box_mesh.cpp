#include "tests/support/box_mesh.hpp"

#include "tests/support/structured_mesh.hpp"

namespace cupola::testing {

BedMesh BoxMesh::make() const {
  return structured_mesh(cells, periodic_y ? upper[1] - lower[1] : 0,
                         [this](const Vector3& share) {
                           Vector3 point{};
                           for (std::size_t axis = 0; axis < 3; ++axis) {
                             point[axis] = lower[axis] + share[axis] * (upper[axis] - lower[axis]);
                           }
                           return deform(point);
                         })
      .mesh;
}

}  // namespace cupola::testing
