#pragma once
#include <algorithm>

namespace cupola {

/// Conductivity of a bed of one species by contact, after Carson et al. (2005), effective-medium theory with a
/// non-conducting gas:
///   k_bed = k_p max(0, (3 a - 1)/2),  a = solids fraction, at most 1.
/// Zero below a = 1/3, k_p at a = 1.  Per area of bed, gradient of the species' mean temperature.
/// @param solid_conductivity k_p, W/m/K  @return W/m/K
inline double bed_conductivity_carson(double solid_conductivity, double solids_fraction) {
  return solid_conductivity * std::max(0.0, (3 * std::min(1.0, solids_fraction) - 1) / 2);
}

}  // namespace cupola
