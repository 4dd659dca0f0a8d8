#pragma once
#include <filesystem>
#include <vector>

#include "schemas/campaign.hpp"
#include "stage_dem/engine.hpp"

namespace cupola::bench {

/// A slot of coke parcels of 0.176 m (the furnace's, 44 mm x 4), 16 diameters wide and about 20 high, `tiles` x 15 deep
/// and periodic there, with gas from below; one tile holds about 5,000 parcels and 5,280 cells.
Campaign dem_bed(int tiles);

/// One tile, poured and settled; on one rank.
std::vector<Parcel> settled_tile(const std::filesystem::path& folder);

/// Tiles side by side along y, ids from 1.
std::vector<Parcel> tiled(const std::vector<Parcel>& tile, int tiles);

}  // namespace cupola::bench
