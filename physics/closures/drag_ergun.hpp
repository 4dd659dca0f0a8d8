#pragma once

namespace cupola {

/// Resistance of a packed bed after Ergun (1952), `-grad p = resistance x U`:
///   150 mu (1-e)^2/(e^3 d^2) + 1.75 rho |U| (1-e)/(e^3 d).
/// Range: packed beds, void fraction below about 0.6, Reynolds number/(1-e) up to some thousands.
/// @param void_fraction e, in (0, 1)
/// @param grain_diameter d, m: Sauter mean of the grains, not of the parcels
/// @param viscosity mu, Pa s  @param density rho of the gas, kg/m3  @param superficial_speed |U|, m/s
/// @return kg/m3/s
inline double ergun_resistance(double void_fraction, double grain_diameter, double viscosity, double density,
                               double superficial_speed) {
  const double solids = 1 - void_fraction;
  const double per_void_cubed = solids / (void_fraction * void_fraction * void_fraction * grain_diameter);
  return per_void_cubed * (150 * viscosity * solids / grain_diameter + 1.75 * density * superficial_speed);
}

}  // namespace cupola
