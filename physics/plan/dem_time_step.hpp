#pragma once
#include <string>

#include "schemas/campaign.hpp"

namespace cupola {

/// The DEM stage's time step and what it is a fraction of.
struct DemTimeStep {
  double step = 0;           ///< s; divides the block exactly
  long steps_per_block = 0;  ///< of `dem.block`
  double reference =
      0;  ///< s: smallest Rayleigh time (Hertz) or collision time (linear spring) of the parcels in the scene
  std::string reference_name;  ///< `Rayleigh time` or `collision time`
  std::string species;         ///< whose parcel has it
  [[nodiscard]] double fraction() const { return step / reference; }
};

/// A step above this fraction of the reference time is refused: at 30 % of the Rayleigh time a bed was seen to fluidise
/// by itself (docs/verification_dem.md), and an explicit step resolves a linear spring no longer.
inline constexpr double largest_stable_fraction = 0.3;

/// `dem.time_step`, or where it is `auto` the stated fraction of the smallest reference time, shortened to divide the
/// block. Softened parcels keep their mass while their radius shrinks, so that their Rayleigh time grows: the
/// unsoftened ones count.  With linear springs every pair of species counts.
/// @throws Failure wrong_input where the step is above `largest_stable_fraction` of the reference time
DemTimeStep dem_time_step(const Campaign& campaign);

}  // namespace cupola
