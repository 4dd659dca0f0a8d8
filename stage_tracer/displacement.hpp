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

/// Cells whose tracers may be displaced (`tracer.displacement_excludes`): bed cells outside the excluded boxes and,
/// with `above_cohesive_zone`, only where the ore has melted or below `none_below`, since displacement mixes layers.
/// @param ore_temperature of this episode, K, all cells; empty without heat: nothing melts, nothing is excluded by it
std::vector<bool> displaced_cells(const BedMesh& mesh, const Campaign& campaign, const std::vector<bool>& bed,
                                  const std::vector<double>& ore_temperature);

/// Relaxation along the gradient of the excess void (the second term of the published displacement): the difference
/// e = alpha_p - a between the packing and the tracers' volume fraction diffuses over the step with D0 (implicit,
/// through faces between displaced cells), and what flows moves the tracers,
///   dr = D0 dt grad e / a, at most `relaxation_limit`.
/// @param displaced cells that take part
/// @return m, all cells; zero where nothing is displaced
std::vector<Vector3> relaxation(const BedMesh& mesh, const std::vector<bool>& displaced,
                                const std::vector<double>& tracer_volume, const std::vector<double>& solids_fraction,
                                const TracerSettings& settings, double seconds);

/// Displaces tracers at random in over-packed cells (paper eq. 12, from the volume-fraction excess): a step of length
/// sqrt(6 D0 e dt), at most `displacement_limit`, in a direction uniform on the sphere, drawn from (seed, tracer,
/// step); and by the relaxation of their cell, where that is given.  A displacement that would leave the bed or enter a
/// wall is not made.
/// @return tracers held back by walls
std::int64_t displace(Tracers& tracers, const TracerSettings& settings, const CellLocator& locator,
                      const PathField& paths, const std::vector<bool>& bed, const std::vector<double>& excess,
                      double seconds, std::uint64_t seed, long step, const std::vector<Vector3>& relaxation = {});

}  // namespace cupola
