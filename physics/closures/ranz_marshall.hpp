#pragma once
#include <cmath>

namespace cupola {

/// Nusselt number of a grain after Ranz and Marshall (1952): Nu = 2 + 0.6 Re^(1/2) Pr^(1/3).
/// Range: single spheres, Re up to about 5x10^4; in beds known to be too high, hence the campaign's `nusselt_factor`.
/// @param reynolds |G| d/mu with the superficial mass flux G and the grain's (not the parcel's) diameter d
inline double nusselt_ranz_marshall(double reynolds, double prandtl) {
  return 2 + 0.6 * std::sqrt(reynolds) * std::cbrt(prandtl);
}

}  // namespace cupola
