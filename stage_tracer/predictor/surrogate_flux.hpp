#pragma once
#include <vector>

#include "physics/projection/bed_projection.hpp"
#include "stage_tracer/granular_field.hpp"

namespace cupola {

/// Granular flux without a DEM stage: potential flow q = -f grad(phi) of the persistent species, f being their share of
/// the solids flux, between the stock plane (evenly) and the raceways' sinks.  With q = f w the velocity field w of the
/// whole bed is a potential flow where f is even, and ore that melts takes no part in the flux below its zone.
/// Within 0.20 to 0.24 of DEM fields (NUMERICS_NOTES); known to lack a dead man.
class SurrogateFlux {
 public:
  /// Keeps references. @param sink m3/s that each cell removes
  SurrogateFlux(FoamCase& foam, const BedMesh& mesh, const std::vector<bool>& bed, std::vector<double> sink);

  /// @param share f, all cells  @return m3/s through each face, out of its owner
  /// @throws Failure diverged
  [[nodiscard]] std::vector<double> operator()(const std::vector<double>& share);

 private:
  const BedMesh& mesh_;
  FaceGeometry geometry_;
  BedFaces faces_;
  BedProjection projection_;
  std::vector<double> sink_;
  double total_ = 0;
};

}  // namespace cupola
