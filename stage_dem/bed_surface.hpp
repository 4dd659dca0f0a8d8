#pragma once
#include <vector>

#include "stage_dem/engine.hpp"

namespace cupola {

/// Height of the bed's surface: the median over columns (one parcel diameter wide, across the slot) of the top of the
/// highest parcel that does not fall, m; the bottom where there is none.  A parcel falls where it is faster than 1 m/s.
double bed_surface(const Campaign& campaign, const std::vector<Parcel>& parcels);

/// Top of the highest parcel of all, m; the bottom where there is none.
double highest_top(const Campaign& campaign, const std::vector<Parcel>& parcels);

}  // namespace cupola
