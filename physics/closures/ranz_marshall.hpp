#pragma once
#include <cmath>

namespace cupola {

/// Nusselt number of a grain after Ranz and Marshall (1952): Nu = 2 + 0.6 Re^(1/2) Pr^(1/3).
/// Range: single spheres, Re up to about 5x10^4; in beds known to be too high, hence the campaign's `nusselt_factor`.
/// @param reynolds |G| d/mu with the superficial mass flux G and the grain's (not the parcel's) diameter d
inline double nusselt_ranz_marshall(double reynolds, double prandtl) {
  return 2 + 0.6 * std::sqrt(reynolds) * std::cbrt(prandtl);
}

/// Heat transfer coefficient between a grain and the gas, `nusselt_factor` x Nu k/d, W/m2/K.
/// @param mass_flux |G| of the gas, kg/m2/s  @param diameter of the grain, m  @param viscosity Pa s
/// @param conductivity of the gas, W/m/K  @param nusselt_factor the campaign's scaling (0.1 in the paper)
inline double heat_transfer_coefficient(double mass_flux, double diameter, double viscosity, double prandtl,
                                        double conductivity, double nusselt_factor) {
  return nusselt_factor * nusselt_ranz_marshall(mass_flux * diameter / viscosity, prandtl) * conductivity / diameter;
}

}  // namespace cupola
