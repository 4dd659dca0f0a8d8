#include "physics/plan/expected_parcels.hpp"

#include <numbers>

namespace cupola {

std::vector<double> expected_parcels(const Campaign& campaign, const std::vector<double>& volume_share,
                                     double packing) {
  constexpr int rows = 400, columns = 100;
  std::vector<double> volume(campaign.species.size(), 0);
  const double bottom = campaign.bottom();
  const double height = (campaign.charging.stock_line - bottom) / rows;
  const auto& zone = campaign.initial.cohesive_zone;
  for (int row = 0; row < rows; ++row) {
    const double z = bottom + (row + 0.5) * height;
    const double width = campaign.half_width(z) / columns;
    const double box = 2 * width * height * campaign.scene.geometry.depth;
    for (int column = 0; column < columns; ++column) {
      const bool molten = zone && z < zone->tip - zone->slope * (column + 0.5) * width;
      std::vector<double> share = volume_share;
      double present = 0;
      for (std::size_t i = 0; i < share.size(); ++i) {
        const Species& species = campaign.species[i];
        if (species.softening && (molten || z < species.none_below)) share[i] = 0;
        present += share[i];
      }
      for (std::size_t i = 0; i < share.size() && present > 0; ++i) volume[i] += box * packing * share[i] / present;
    }
  }
  std::vector<double> parcels;
  for (std::size_t i = 0; i < volume.size(); ++i) {
    const double diameter = campaign.species[i].parcel_diameter();
    parcels.push_back(volume[i] / (std::numbers::pi / 6 * diameter * diameter * diameter));
  }
  return parcels;
}

}  // namespace cupola
