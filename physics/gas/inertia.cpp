#include "physics/gas/inertia.hpp"

#include <cmath>

#include "physics/equations/face_geometry.hpp"
#include "physics/gas/drag_tangent.hpp"

namespace cupola {

std::vector<double> inertia_over_drag(const BedMesh& mesh, const GasFlow& flow, double least_mass_flux) {
  std::vector<Vector3> velocity(mesh.cells());
  for (std::size_t cell = 0; cell < mesh.cells(); ++cell) {
    for (std::size_t axis = 0; axis < 3; ++axis) {
      velocity[cell][axis] = flow.mass_flux[cell][axis] / (flow.density[cell] * flow.void_fraction[cell]);
    }
  }
  std::vector<Vector3> force(mesh.cells(), Vector3{0, 0, 0});
  for (std::size_t face = 0; face < mesh.faces(); ++face) {
    const auto neighbour = mesh.face_neighbour[face];
    if (neighbour < 0) continue;
    const auto owner = mesh.face_owner[face];
    const double flux = flow.face_mass_flux[face];
    // Only what flows in brings another velocity than the cell's own.
    const auto into = flux > 0 ? neighbour : owner;
    const auto from = flux > 0 ? owner : neighbour;
    // A periodic face's neighbour has a face of its own.
    if (into == neighbour && face >= mesh.internal_faces()) continue;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      force[into][axis] += std::abs(flux) * (velocity[into][axis] - velocity[from][axis]) / mesh.cell_volume[into];
    }
  }
  std::vector<double> ratio(mesh.cells(), 0);
  for (std::size_t cell = 0; cell < mesh.cells(); ++cell) {
    const Vector3& g = flow.mass_flux[cell];
    if (flow.void_fraction[cell] > 1 - empty_solids_fraction || dot(g, g) < least_mass_flux * least_mass_flux) continue;
    ratio[cell] = std::sqrt(dot(force[cell], force[cell])) / (flow.void_fraction[cell] * flow.drag[cell]);
  }
  return ratio;
}

}  // namespace cupola
