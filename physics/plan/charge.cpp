#include "physics/plan/charge.hpp"

#include <algorithm>
#include <numeric>

namespace cupola {

double Charge::total_mass_rate() const { return std::accumulate(mass_rate.begin(), mass_rate.end(), 0.0); }

double slot_area(const Campaign& campaign, double z) {
  return 2 * campaign.half_width(z) * campaign.scene.geometry.depth;
}

bool charged_in_layers(const Campaign& campaign) {
  const auto& layers = campaign.charging.layers;
  return std::all_of(layers.begin(), layers.end(), [](const Layer& layer) {
    return std::count_if(layer.begin(), layer.end(), [](const auto& part) { return part.second > 0; }) == 1;
  });
}

Charge charge_of(const Campaign& campaign, double packing) {
  const std::size_t count = campaign.species.size();
  Charge charge;
  charge.area = slot_area(campaign, campaign.charging.stock_line);
  charge.packing = packing;
  charge.layer_thickness.assign(count, 0);
  std::vector<double> volume(count, 0);
  std::vector<int> layers_with(count, 0);
  for (const Layer& layer : campaign.charging.layers) {
    double layer_volume = 0;
    for (const auto& [name, mass] : layer)
      layer_volume += mass / campaign.species[campaign.species_index(name)].density;
    const double thickness = layer_volume / packing / charge.area;
    charge.recipe_thickness += thickness;
    for (const auto& [name, mass] : layer) {
      const std::size_t i = campaign.species_index(name);
      volume[i] += mass / campaign.species[i].density;
      if (mass > 0) {
        charge.layer_thickness[i] += thickness;
        ++layers_with[i];
      }
    }
  }
  const double total = std::accumulate(volume.begin(), volume.end(), 0.0);
  const double rate = campaign.descent_rate * charge.area * packing;
  for (std::size_t i = 0; i < count; ++i) {
    charge.volume_share.push_back(total > 0 ? volume[i] / total : 0);
    charge.volume_rate.push_back(rate * charge.volume_share[i]);
    charge.mass_rate.push_back(charge.volume_rate[i] * campaign.species[i].density);
    if (layers_with[i] > 0) charge.layer_thickness[i] /= layers_with[i];
  }
  charge.recipe_time = campaign.descent_rate > 0 ? charge.recipe_thickness / campaign.descent_rate : 0;
  return charge;
}

double dem_speed_up(const Campaign& campaign, const Charge& charge) {
  double removed = 0;
  for (const Raceway& raceway : campaign.raceways) removed += raceway.dem_removal_rate;
  double charged = 0;
  for (std::size_t i = 0; i < campaign.species.size(); ++i) {
    if (!campaign.species[i].softening) charged += charge.mass_rate[i];
  }
  return charged > 0 ? removed / charged : 0;
}

}  // namespace cupola
