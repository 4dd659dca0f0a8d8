#pragma once
#include <cmath>

#include "physics/closures/drag_ergun.hpp"

namespace cupola {

/// Resistance of dispersed grains after Wen and Yu (1966), `-grad p = resistance x U`:
///   3/4 C_D rho |U| (1-e)/d e^-4.65,  C_D = 24/Re (1 + 0.15 Re^0.687) below Re = rho |U| d/mu = 1000, 0.44 above.
/// (The exchange coefficient 3/4 C_D e (1-e) rho |u_slip|/d e^-2.65 over e^2.)  Range: void fraction above 0.8.
/// Units and arguments as `ergun_resistance`.
inline double wen_yu_resistance(double void_fraction, double grain_diameter, double viscosity, double density,
                                double superficial_speed) {
  const double reynolds = density * superficial_speed * grain_diameter / viscosity;
  // C_D Re/24, finite for a gas at rest.
  const double over_stokes = reynolds < 1000 ? 1 + 0.15 * std::pow(reynolds, 0.687) : 0.44 * reynolds / 24;
  return 18 * viscosity * (1 - void_fraction) / (grain_diameter * grain_diameter) * over_stokes *
         std::pow(void_fraction, -4.65);
}

/// Resistance after Gidaspow, Bezburuah and Ding (1992): Ergun up to a void fraction of 0.8, Wen and Yu above.  As
/// published, that is with the jump at 0.8 (about 10 to 30 % for grains of a few millimetres and more). Units and
/// arguments as `ergun_resistance`.
inline double gidaspow_resistance(double void_fraction, double grain_diameter, double viscosity, double density,
                                  double superficial_speed) {
  return void_fraction > 0.8 ? wen_yu_resistance(void_fraction, grain_diameter, viscosity, density, superficial_speed)
                             : ergun_resistance(void_fraction, grain_diameter, viscosity, density, superficial_speed);
}

}  // namespace cupola
