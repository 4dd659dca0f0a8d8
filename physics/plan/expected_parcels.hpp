#pragma once
#include <vector>

#include "schemas/campaign.hpp"

namespace cupola {

/// Expected number of parcels in the bed, by species: the volume between bottom and stock line at the packing, layered
/// by the recipe above the guessed cohesive zone and where nothing is yet molten (`none_below`), without the softening
/// species below. Parcels in the hopper and voids of the raceways are not counted.
std::vector<double> expected_parcels(const Campaign& campaign, const std::vector<double>& volume_share, double packing);

}  // namespace cupola
