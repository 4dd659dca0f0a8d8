#pragma once
#include <vector>

#include "physics/plan/charge.hpp"
#include "physics/projection/cell_spreading.hpp"
#include "stage_tracer/ranks.hpp"
#include "stage_tracer/tracers.hpp"

namespace cupola {

/// Arrays [species][cell].
using BySpecies = std::vector<std::vector<double>>;

/// The arrays as the kernel takes them, together.
std::vector<std::vector<double>*> pointers(BySpecies& arrays);

/// What the tracers of all ranks carry in each cell.
struct CellContents {
  BySpecies volume;       ///< m3, material
  BySpecies temperature;  ///< K, volume-weighted mean of each species; 0 where there is none; empty without heat
};

/// Diameter of the parcels whose volume is spread: mean by the recipe's volume, or of all species, m.
double kernel_diameter(const Campaign& campaign, const Charge& charge);

/// The contents spread with the kernel of a parcel: volumes and heat are conserved.
CellContents spread(const CellContents& contents, const CellSpreading& kernel);

/// 1 = all solids of the cell: each species' share of the solids volume. Cells that no tracer reaches count as
/// `empty_share`.
BySpecies volume_shares(const CellContents& spread_contents, const std::vector<double>& empty_share);

}  // namespace cupola
