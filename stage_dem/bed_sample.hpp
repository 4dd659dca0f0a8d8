#pragma once
#include <set>
#include <vector>

#include "stage_dem/solids_on_mesh.hpp"
#include "stage_dem/window_averages.hpp"

namespace cupola {

/// What a block contributes to the averages: fractions of each species and the flux of its displacement over the
/// block's time, over all ranks.  Collective.
/// @param solids the parcels `owned`, divided  @param falling ids that are not of the bed yet  @param seconds of the
/// block
/// @return one sample a species
std::vector<BedSample> sample_bed(const Campaign& campaign, const BedMesh& mesh, const SolidsOnMesh& solids,
                                  const std::vector<Parcel>& owned, const std::set<std::int64_t>& falling,
                                  double seconds);

/// The species taken together.
BedSample sum_of(const std::vector<BedSample>& species);

}  // namespace cupola
