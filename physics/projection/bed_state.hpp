#pragma once
#include <cstdint>
#include <vector>

#include "physics/mesh/bed_mesh.hpp"
#include "schemas/campaign.hpp"

namespace cupola {

/// What the gas sees of the bed: arrays over all cells (BedMesh order), the same on every rank.
struct BedState {
  std::vector<double>
      void_fraction;  ///< of the gas: 1 - material volume fraction, with the floor and the raceways' minimum
  std::vector<double> grain_diameter;  ///< m, Sauter mean of the unsoftened grains; the largest species' in empty cells
  std::vector<double> drag_factor;     ///< on the drag law at the mean grain: mixtures with Beetstra, `filtered_drag`
  std::int64_t cells_at_floor =
      0;  ///< cells denser than the floor of the void fraction: a limit of the model, to be reported
};

/// Least void fraction the gas closures see (MODEL 5): melts and overlaps of softened parcels would close the bed
/// otherwise.
inline constexpr double least_void_fraction = 0.10;

/// Void fraction, Sauter diameter and the factor on the drag law from the material volume of each species in each cell.
///   void = 1 - sum_i V_i / V_cell, at least `least_void_fraction` (MODEL 5), in raceways at least theirs (MODEL 6),
///   1/d = sum_i (V_i/d_i) / sum_i V_i.
/// @param species_volume m3, [species][cell], species in the campaign's order
/// @throws Failure diverged where a volume is not finite or negative (names the cell)
BedState bed_state(const BedMesh& mesh, const Campaign& campaign,
                   const std::vector<std::vector<double>>& species_volume);

/// Cells whose centre lies below the stock plane.
std::vector<bool> bed_cells(const BedMesh& mesh, const Campaign& campaign);

/// Indices of the cells whose centre lies in the raceway's box.
std::vector<std::int64_t> raceway_cells(const BedMesh& mesh, const Raceway& raceway);

}  // namespace cupola
