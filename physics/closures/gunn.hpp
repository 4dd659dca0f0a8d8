#pragma once
#include <cmath>

namespace cupola {

/// Nusselt number of a grain in a bed after Gunn (Int. J. Heat Mass Transfer 21, 1978, 467):
///   Nu = (7 - 10 e + 5 e^2)(1 + 0.7 Re^0.2 Pr^(1/3)) + (1.33 - 2.4 e + 1.2 e^2) Re^0.7 Pr^(1/3).
/// Range: void fraction e from 0.35 to 1, Re up to 1e5; used as it stands beyond.
/// @param reynolds |G| d/mu with the superficial mass flux G and the grain's diameter d
inline double nusselt_gunn(double reynolds, double prandtl, double void_fraction) {
  const double e = void_fraction;
  const double third = std::cbrt(prandtl);
  return (7 - 10 * e + 5 * e * e) * (1 + 0.7 * std::pow(reynolds, 0.2) * third) +
         (1.33 - 2.4 * e + 1.2 * e * e) * std::pow(reynolds, 0.7) * third;
}

}  // namespace cupola
