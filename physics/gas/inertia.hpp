#pragma once
#include <vector>

#include "physics/mesh/bed_mesh.hpp"

namespace cupola {

/// A solved flow, arrays over all cells and faces.
struct GasFlow {
  const std::vector<double>& face_mass_flux;  ///< kg/s out of the owner
  const std::vector<Vector3>& mass_flux;      ///< kg/m2/s, superficial
  const std::vector<double>& density;         ///< kg/m3
  const std::vector<double>& void_fraction;
  const std::vector<double>& drag;  ///< N/m3, resistance x superficial speed
};

/// Inertia over drag in every cell, |div(G u)|/(e r |U|), u = G/(density e) the interstitial velocity, upwind: what
/// Darcy and Forchheimer leave out.  0 where |G| is below `least_mass_flux` and in empty cells.
std::vector<double> inertia_over_drag(const BedMesh& mesh, const GasFlow& flow, double least_mass_flux);

}  // namespace cupola
