#include "tests/support/settled_bed.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "physics/closures/guessed_zone.hpp"
#include "physics/plan/charge.hpp"
#include "tests/support/stated_bed.hpp"

namespace cupola::testing {
namespace {

bool molten(const Campaign& campaign, const Species& species, const Vector3& position) {
  if (!species.softening) return false;
  if (position[2] < species.none_below) return true;
  return campaign.heat && campaign.initial.cohesive_zone &&
         guessed_temperature(*campaign.initial.cohesive_zone, position) >= species.softening->melted;
}

bool in_a_raceway(const Campaign& campaign, const Vector3& position) {
  return std::any_of(campaign.raceways.begin(), campaign.raceways.end(), [&](const Raceway& raceway) {
    for (std::size_t k = 0; k < 3; ++k) {
      if (position[k] < raceway.box[0][k] || position[k] > raceway.box[1][k]) return false;
    }
    return true;
  });
}

/// Layers from the stock line down, the last of the recipe uppermost, until the bottom is reached.
void fill(StatedBed& bed, const Campaign& campaign, const Charge& charge) {
  double top = std::min(campaign.charging.stock_line, campaign.top());
  for (std::size_t turn = 0; top > campaign.bottom(); ++turn) {
    const std::size_t layer = campaign.charging.layers.size() - 1 - turn % campaign.charging.layers.size();
    const auto& [name, mass] = *campaign.charging.layers[layer].begin();
    const std::size_t s = campaign.species_index(name);
    const double bottom = std::max(campaign.bottom(), top - charge.layer_thickness[s]);
    // Where the ore has melted, coke is left.
    for (std::size_t k = 0; k < campaign.species.size(); ++k) {
      const Species& species = campaign.species[k];
      if (k != s && species.softening) continue;
      const double diameter = species.parcel_diameter();
      const double spacing = diameter * std::cbrt(std::numbers::pi / 6 / expected_packing);
      for (double z = top - spacing / 2; z > bottom; z -= spacing) {
        const double width = campaign.half_width(z) - diameter / 2;
        for (double x = -width; x <= width; x += spacing) {
          for (double y = (spacing - campaign.scene.geometry.depth) / 2; y < campaign.scene.geometry.depth / 2;
               y += spacing) {
            const Vector3 position{x, y, z};
            const bool layer_is_molten = molten(campaign, campaign.species[s], position);
            if (k == s ? layer_is_molten : !layer_is_molten) continue;
            bed.add_parcel(static_cast<std::int64_t>(k), position, diameter / 2,
                           std::numbers::pi / 6 * diameter * diameter * diameter * species.density);
          }
        }
      }
    }
    top -= charge.layer_thickness[s];
  }
}

}  // namespace

void write_settled_bed(const std::filesystem::path& file, const BedMesh& mesh, const Task& task, double speed_up) {
  const Campaign& campaign = task.campaign;
  const Charge charge = charge_of(campaign);
  double raceway_top = campaign.bottom();
  for (const Raceway& raceway : campaign.raceways) raceway_top = std::max(raceway_top, raceway.box[1][2]);
  StatedBed bed;
  bed.solids_fraction.assign(mesh.cells(), 0.0);
  bed.solids_velocity.assign(mesh.cells(), Vector3{});
  for (std::size_t c = 0; c < mesh.cells(); ++c) {
    const Vector3& r = mesh.cell_centre[c];
    if (r[2] > campaign.charging.stock_line) continue;
    bed.solids_fraction[c] = in_a_raceway(campaign, r) ? 0.3 : expected_packing;
    const double slope = (campaign.half_width(r[2] + 0.05) - campaign.half_width(r[2] - 0.05)) / 0.1;
    const double fade = std::clamp((r[2] - campaign.bottom()) / (raceway_top - campaign.bottom() + 1e-9), 0.0, 1.0);
    const double down = -speed_up * campaign.descent_rate * charge.area / slot_area(campaign, r[2]) * fade;
    bed.solids_velocity[c] = {down * slope * r[0] / campaign.half_width(r[2]), 0, down};
  }
  fill(bed, campaign, charge);
  if (!campaign.raceways.empty()) {
    for (std::size_t k = 0; k < campaign.species.size(); ++k) {
      if (!campaign.species[k].softening) bed.coke_removal_rate += speed_up * charge.mass_rate[k];
    }
    bed.removal_by_raceway.assign(campaign.raceways.size(),
                                  bed.coke_removal_rate / static_cast<double>(campaign.raceways.size()));
  }
  write_stated_bed(file, mesh, task, bed);
}

}  // namespace cupola::testing
