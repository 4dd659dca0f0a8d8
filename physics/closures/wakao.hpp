#pragma once
#include <cmath>

namespace cupola {

/// Nusselt number of a grain in a packed bed after Wakao, Kaguei and Funazkri (Chem. Eng. Sci. 34, 1979, 325):
///   Nu = 2 + 1.1 Re^0.6 Pr^(1/3).
/// Range: packed beds of spheres, Re from 15 to 8500; used as it stands beyond.
/// @param reynolds |G| d/mu with the superficial mass flux G and the grain's diameter d
inline double nusselt_wakao(double reynolds, double prandtl) {
  return 2 + 1.1 * std::pow(reynolds, 0.6) * std::cbrt(prandtl);
}

}  // namespace cupola
