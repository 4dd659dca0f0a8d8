#pragma once
#include <cstdint>
#include <vector>

#include "physics/mesh/bed_mesh.hpp"
#include "physics/mesh/cell_locator.hpp"
#include "schemas/campaign.hpp"
#include "stage_tracer/tracers.hpp"

namespace cupola {

/// Excess of the tracers' volume over the packing of the granular field, e = (a - alpha_p)/a with a the tracers' volume
/// fraction; 0 where there is no excess.
/// @param tracer_volume m3, all cells  @param solids_fraction alpha_p, all cells
std::vector<double> volume_excess(const BedMesh& mesh, const std::vector<bool>& bed,
                                  const std::vector<double>& tracer_volume, const std::vector<double>& solids_fraction);

/// Random displacement in over-packed cells (paper eq. 12, from the volume-fraction excess): a step of length sqrt(6 D0
/// e dt), at most `displacement_limit`, in a direction uniform on the sphere, drawn from (seed, tracer, step).  A
/// displacement that would leave the bed or enter a wall is not made.
/// @return tracers held back by walls
std::int64_t displace(Tracers& tracers, const TracerSettings& settings, const CellLocator& locator,
                      const PathField& paths, const std::vector<bool>& bed, const std::vector<double>& excess,
                      double seconds, std::uint64_t seed, long step);

}  // namespace cupola
