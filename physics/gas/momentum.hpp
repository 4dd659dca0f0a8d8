#pragma once
#include <vector>

#include "physics/gas/openings.hpp"

namespace cupola {

/// What the gas's inertia and viscosity add to the law of each cell, in terms of psi = p^2/2:
///   -grad psi = (R T/M)(r + r_i) G - push.
/// From the steady momentum balance in terms of the interstitial velocity u = G/(rho e) (paper eq. 8),
///   div(G u) - div(e mu grad u) = -e grad p - e r U,
/// first-order upwind: r_i = a/(V e^2) holds the cell's own share, a = inflow + sum e mu A/d, push = p/(e V) sum(inflow
/// u_upstream + e mu A/d u_beside) what comes from beside it.
struct MomentumTerms {
  std::vector<double> resistance;  ///< (R T/M) r_i, 1/s, all cells
  std::vector<Vector3> push;       ///< Pa2/m, all cells
};

/// The present state of a flow, arrays over all cells and faces.
struct MomentumState {
  const std::vector<double>& face_mass_flux;   ///< kg/s out of the owner
  const std::vector<Vector3>& velocity;        ///< u, interstitial, m/s
  const std::vector<double>& pressure;         ///< Pa
  const std::vector<double>& temperature;      ///< K, static
  const std::vector<double>& void_fraction;    ///< 1
  const std::vector<Vector3>& inlet_velocity;  ///< m/s, of each inlet's jet, along its faces' normals inwards
};

/// Walls slip: no shear stress acts on them.  Gas that flows back through the outlet has the cell's own velocity.
MomentumTerms momentum_terms(const BedMesh& mesh, const FaceGeometry& geometry, const Openings& openings,
                             const Gas& gas, const MomentumState& state);

}  // namespace cupola
