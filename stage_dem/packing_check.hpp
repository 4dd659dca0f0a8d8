#pragma once
#include <vector>

#include "stage_dem/engine.hpp"

namespace cupola {

/// Whether a packing that is handed over can be the beginning of a stage: ids, sizes and places are those of parcels of
/// this campaign, all lie inside the furnace or the hopper above it, and none overlaps another or a wall by more than
/// `dem.limits` accepts in a run (contacts that deep would throw the bed apart at the first step).
/// @throws Failure wrong_input that names the parcel, its place and the file
void check_packing(const Campaign& campaign, const std::vector<Parcel>& parcels, const std::string& file);

}  // namespace cupola
