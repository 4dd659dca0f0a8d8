#pragma once
#include <cmath>

namespace cupola {

/// Resistance after Di Felice (Int. J. Multiphase Flow 20, 1994, 153), `-grad p = resistance x U`:
///   3/4 C_D rho |U| a/d e^-(chi + 1),  a = 1 - e,  Re = rho |U| d/mu,
///   C_D = (0.63 + 4.8/sqrt(Re))^2 (Dallavalle),  chi = 3.7 - 0.65 exp(-(1.5 - log10 Re)^2/2).
/// The published e^-chi is for the drag without the pressure gradient's share; the whole resistance has e once more.
/// Range: void fractions from packed (0.4) to 1, Re from creeping flow to some 10^4.  Units and arguments as
/// `ergun_resistance`.
inline double di_felice_resistance(double void_fraction, double grain_diameter, double viscosity, double density,
                                   double superficial_speed) {
  const double reynolds = density * superficial_speed * grain_diameter / viscosity;
  // C_D Re, finite for a gas at rest.
  const double drag = std::pow(0.63 * std::sqrt(reynolds) + 4.8, 2);
  double chi = 3.7;
  if (reynolds > 0) chi -= 0.65 * std::exp(-std::pow(1.5 - std::log10(reynolds), 2) / 2);
  return 0.75 * viscosity * (1 - void_fraction) / (grain_diameter * grain_diameter) * drag *
         std::pow(void_fraction, -(chi + 1));
}

}  // namespace cupola
