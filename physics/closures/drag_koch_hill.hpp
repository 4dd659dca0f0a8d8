#pragma once
#include <cmath>

namespace cupola {

/// Resistance after Hill, Koch and Ladd (J. Fluid Mech. 448, 2001, 213 and 243) from lattice-Boltzmann simulations, in
/// the form in general use since Koch and Hill (Annu. Rev. Fluid Mech. 33, 2001, 619), `-grad p = resistance x U`:
///   18 mu a/d^2 (F0 + F3 Re/2),  a = 1 - e,  Re = rho |U| d/mu,
///   F0 = (1 + 3 sqrt(a/2) + 135/64 a ln a + 16.14 a)/(1 + 0.681 a - 8.48 a^2 + 8.16 a^3) for a < 0.4,
///   F0 = 10 a/e^3 from there on (Carman),  F3 = 0.0673 + 0.212 a + 0.0232/e^5.
/// Range: a up to 0.64, Re up to about 200; the quadratic start of the inertial part at small Re is left out (a few per
/// cent).  Units and arguments as `ergun_resistance`.
inline double koch_hill_resistance(double void_fraction, double grain_diameter, double viscosity, double density,
                                   double superficial_speed) {
  const double a = 1 - void_fraction;
  const double reynolds = density * superficial_speed * grain_diameter / viscosity;
  double creeping = 1;
  if (a >= 0.4) {
    creeping = 10 * a / std::pow(void_fraction, 3);
  } else if (a > 0) {
    creeping = (1 + 3 * std::sqrt(a / 2) + 135.0 / 64 * a * std::log(a) + 16.14 * a) /
               (1 + a * (0.681 + a * (-8.48 + 8.16 * a)));
  }
  const double inertial = 0.0673 + 0.212 * a + 0.0232 / std::pow(void_fraction, 5);
  return 18 * viscosity * a / (grain_diameter * grain_diameter) * (creeping + inertial * reynolds / 2);
}

}  // namespace cupola
