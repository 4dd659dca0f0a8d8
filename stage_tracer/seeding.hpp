#pragma once
#include <cstdint>
#include <vector>

#include "physics/mesh/bed_mesh.hpp"
#include "physics/mesh/cell_locator.hpp"
#include "schemas/campaign.hpp"
#include "stage_tracer/dem_result.hpp"
#include "stage_tracer/tracers.hpp"

namespace cupola {

/// Into how many tracers each parcel is split, so that bed cells hold `tracer.tracers_per_cell` on average: at least 1.
/// @throws Failure wrong_input: no parcel in the bed
int tracers_per_parcel(const Campaign& campaign, const CellLocator& locator, const std::vector<bool>& bed,
                       const Packing& packing);

/// Seeds this rank's tracers (`rank_of`) from the packing: parcels with their centre in the bed, each split
/// into `split` equal tracers at random points of the parcel's ball (in its centre where that point lies outside the
/// bed).  Volume is mass/density.
/// @param paths gives the reference point inside a cell
/// Temperatures are left empty.
Tracers seed_tracers(const Campaign& campaign, const CellLocator& locator, const PathField& paths,
                     const std::vector<bool>& bed, const Packing& packing, int split, std::uint64_t seed, int rank,
                     int ranks);

}  // namespace cupola
