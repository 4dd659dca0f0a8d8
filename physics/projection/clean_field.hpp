#pragma once
#include <vector>

#include "physics/mesh/bed_mesh.hpp"
#include "physics/mesh/foam_case.hpp"

namespace cupola {

/// Input of the cleaning of a granular field (docs/contracts.md, MODEL 8); arrays over all cells.
struct RawGranularField {
  /// m/s: coke share of the solids flux x solids fraction x velocity, at DEM speed or scaled
  std::vector<Vector3> coke_flux;
  /// 1/s: solids volume of coke removed per cell volume and second, positive; the raceways
  std::vector<double> sink;
  std::vector<bool> bed;  ///< cells below the stock plane; elsewhere the flux is zero
  int smoothing_passes = 0;
  bool mirror_symmetric = false;  ///< average with the mirror image in x where mesh and raceways are symmetric
};

/// Result: volume fluxes of coke through all faces (BedMesh numbering, out of the owner, m3/s), with div = -sink
/// in every bed cell to solver round-off, no flux through walls, inflow at the stock plane spread like the raw
/// field's (uniform where that has none) and scaled to the total sink.  The correction of a face is weighted with the
/// speed beside it, so that what stands still in the raw field (the dead man) stays nearly still.
struct CleanGranularField {
  std::vector<double> face_flux;
  double error_before = 0;  ///< rms of (div q + sink) over rms of |q|/cell size, of the raw field
  double error_after = 0;   ///< the same of the result
  double change = 0;        ///< |cleaned - raw| / |raw|, L2 over cells
};
/// @throws Failure wrong_input: no bed cell, no stock plane, or a mesh that is not its own mirror image; diverged
CleanGranularField clean_granular_field(FoamCase& foam, const BedMesh& mesh, const RawGranularField& raw);

}  // namespace cupola
