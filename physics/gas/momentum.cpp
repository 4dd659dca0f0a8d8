#include "physics/gas/momentum.hpp"

#include <algorithm>
#include <cmath>

#include "physics/closures/gas_properties.hpp"
#include "physics/closures/sutherland.hpp"
#include "physics/gas/cell_vectors.hpp"

namespace cupola {

MomentumTerms momentum_terms(const BedMesh& mesh, const FaceGeometry& geometry, const Openings& openings,
                             const Gas& gas, const MomentumState& state) {
  const double specific_gas_constant = molar_gas_constant / gas.molar_mass;
  MomentumTerms terms{std::vector<double>(mesh.cells(), 0), std::vector<Vector3>(mesh.cells(), Vector3{0, 0, 0})};
  std::vector<double> shear(mesh.cells());
  for (std::size_t cell = 0; cell < mesh.cells(); ++cell)
    shear[cell] = std::min(1.0, state.void_fraction[cell]) * gas_viscosity(gas, state.temperature[cell]);

  // `resistance` holds the coefficient a, `push` what comes from beside, until the end.
  const auto from_beside = [&](std::int64_t cell, double weight, const Vector3& velocity) {
    terms.resistance[cell] += weight;
    add(terms.push[cell], weight, velocity);
  };
  for (std::size_t face = 0; face < mesh.faces(); ++face) {
    const auto owner = mesh.face_owner[face];
    const auto neighbour = mesh.face_neighbour[face];
    const double flux = state.face_mass_flux[face];
    if (neighbour < 0) {
      if (flux < 0 && openings.is_inlet(face))
        from_beside(owner, -flux, state.inlet_velocity[static_cast<std::size_t>(openings.inlet_of(face))]);
      continue;
    }
    const double diffusion = geometry.area[face] / (geometry.owner_distance[face] / shear[owner] +
                                                    geometry.neighbour_distance[face] / shear[neighbour]);
    from_beside(owner, diffusion + std::max(0.0, -flux), state.velocity[neighbour]);
    // A periodic face's neighbour has a face of its own.
    if (face < mesh.internal_faces()) from_beside(neighbour, diffusion + std::max(0.0, flux), state.velocity[owner]);
  }
  for (std::size_t cell = 0; cell < mesh.cells(); ++cell) {
    const double e = state.void_fraction[cell];
    terms.resistance[cell] *= specific_gas_constant * state.temperature[cell] / (mesh.cell_volume[cell] * e * e);
    for (double& component : terms.push[cell]) component *= state.pressure[cell] / (e * mesh.cell_volume[cell]);
  }
  return terms;
}

}  // namespace cupola
