#pragma once
#include <vector>

#include "schemas/campaign.hpp"

namespace cupola {

/// Solids fraction of the settled bed where nothing measured is at hand (friction 0.9 and rolling friction 0.5 give
/// 0.52 to 0.58).
inline constexpr double expected_packing = 0.56;

/// What the descent rate means for the charge: descent rate x stock-line area x packing is the solids' volume flow,
/// split by the recipe.  Species in the order of the campaign.
struct Charge {
  double area = 0;                   ///< m2, of the slot at the stock line
  double packing = 0;                ///< solids fraction used
  std::vector<double> volume_share;  ///< of the solids volume of one recipe, sums to 1
  std::vector<double> volume_rate;   ///< m3/s of solids
  std::vector<double> mass_rate;     ///< kg/s
  std::vector<double>
      layer_thickness;          ///< m at the stock line, mean over the layers that hold the species; 0: none does
  double recipe_thickness = 0;  ///< m at the stock line, all layers of one recipe
  double recipe_time = 0;       ///< s, passage of one recipe: charging interval and period of the tracer stage

  [[nodiscard]] double total_mass_rate() const;
};

/// @param packing solids fraction at the stock line
Charge charge_of(const Campaign& campaign, double packing = expected_packing);

/// How much faster than the furnace the DEM stage runs: raceway removal there over the charge of the species that reach
/// the raceways (those that never melt); 0 without raceways or such species.
double dem_speed_up(const Campaign& campaign, const Charge& charge);

/// Every layer of the recipe holds one species only, so that ore and coke lie in layers of their own.
bool charged_in_layers(const Campaign& campaign);

/// Horizontal area of the slot at a height, m2.
double slot_area(const Campaign& campaign, double z);

}  // namespace cupola
