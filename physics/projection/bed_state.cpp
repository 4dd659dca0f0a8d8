#include "physics/projection/bed_state.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "physics/closures/drag_beetstra.hpp"
#include "physics/closures/drag_filtered.hpp"
#include "physics/equations/cell_failure.hpp"

namespace cupola {
namespace {

/// Moments of the grains in one cell that the drag laws ask for.
struct Grains {
  double volume = 0;                 // m3
  double volume_over_diameter = 0;   // m2
  double volume_times_diameter = 0;  // m4
  double volume_times_graining = 0;  // m3
  double mass = 0;                   // kg

  [[nodiscard]] double sauter_diameter() const { return volume / volume_over_diameter; }
  [[nodiscard]] double mean_size_ratio() const { return volume_times_diameter / volume / sauter_diameter(); }
};

/// Factor on the drag law at the mean grain.
double drag_factor(const Campaign& campaign, const Grains& grains, double solids_fraction, double cell_volume) {
  double factor = 1;
  if (campaign.drag == DragLaw::beetstra) factor *= beetstra_polydispersity(grains.mean_size_ratio());
  if (!campaign.filtered_drag || !campaign.scene.gas) return factor;
  factor *=
      parcel_drag_correction(campaign.filtered_drag->parcel_coefficient, grains.volume_times_graining / grains.volume);
  if (campaign.filtered_drag->grid) {
    const double size = filter_size(std::cbrt(cell_volume), grains.sauter_diameter(), grains.mass / grains.volume,
                                    campaign.scene.gas->viscosity);
    factor *= grid_drag_correction(size, solids_fraction);
  }
  return factor;
}

}  // namespace

std::vector<bool> bed_cells(const BedMesh& mesh, const Campaign& campaign) {
  std::vector<bool> bed(mesh.cells());
  for (std::size_t c = 0; c < mesh.cells(); ++c) bed[c] = mesh.cell_centre[c][2] < campaign.charging.stock_line;
  return bed;
}

std::vector<std::int64_t> raceway_cells(const BedMesh& mesh, const Raceway& raceway) {
  std::vector<std::int64_t> cells;
  for (std::size_t cell = 0; cell < mesh.cells(); ++cell) {
    const Vector3& centre = mesh.cell_centre[cell];
    bool inside = true;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      inside = inside && centre[axis] >= raceway.box[0][axis] && centre[axis] <= raceway.box[1][axis];
    }
    if (inside) cells.push_back(static_cast<std::int64_t>(cell));
  }
  return cells;
}

BedState bed_state(const BedMesh& mesh, const Campaign& campaign,
                   const std::vector<std::vector<double>>& species_volume) {
  double largest_diameter = 0;
  for (const auto& species : campaign.species) largest_diameter = std::max(largest_diameter, species.diameter);

  BedState bed;
  bed.void_fraction.resize(mesh.cells());
  bed.grain_diameter.assign(mesh.cells(), largest_diameter);
  bed.drag_factor.assign(mesh.cells(), 1);
  for (std::size_t cell = 0; cell < mesh.cells(); ++cell) {
    Grains grains;
    for (std::size_t species = 0; species < campaign.species.size(); ++species) {
      const double volume = species_volume[species][cell];
      if (!(volume >= 0) || !std::isfinite(volume)) {
        throw cell_failure(mesh, fmt::format("volume of {} is {} m3", campaign.species[species].name, volume), cell);
      }
      const double diameter = campaign.species[species].diameter;
      grains.volume += volume;
      grains.volume_over_diameter += volume / diameter;
      grains.volume_times_diameter += volume * diameter;
      grains.volume_times_graining += volume * campaign.species[species].coarse_graining;
      grains.mass += volume * campaign.species[species].density;
    }
    bed.void_fraction[cell] = 1 - grains.volume / mesh.cell_volume[cell];
    if (bed.void_fraction[cell] < least_void_fraction) {
      bed.void_fraction[cell] = least_void_fraction;
      ++bed.cells_at_floor;
    }
    if (grains.volume > 0) {
      bed.grain_diameter[cell] = grains.sauter_diameter();
      bed.drag_factor[cell] = drag_factor(campaign, grains, 1 - bed.void_fraction[cell], mesh.cell_volume[cell]);
    }
  }
  for (const auto& raceway : campaign.raceways) {
    for (const auto cell : raceway_cells(mesh, raceway)) {
      bed.void_fraction[cell] = std::max(bed.void_fraction[cell], raceway.void_fraction);
    }
  }
  return bed;
}

}  // namespace cupola
