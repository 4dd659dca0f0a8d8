#pragma once
#include <algorithm>
#include <cmath>

namespace cupola {

/// Resistance after Beetstra, van der Hoef and Kuipers (AIChE J. 53, 2007, 489), from lattice-Boltzmann simulations,
/// `-grad p = resistance x U`:
///   18 mu a F/(e d^2),  a = 1 - e,  Re = rho |U| d/mu,
///   F = 10 a/e^2 + e^2 (1 + 1.5 sqrt a) + 0.413 Re/(24 e^2) (1/e + 3 a e + 8.4 Re^-0.343)/(1 + 10^(3a) Re^-(1+4a)/2).
/// F is the drag of a grain over Stokes' 3 pi mu d U, without the pressure gradient's share.
/// Range: 0.1 <= a <= 0.6, Re up to 1000; used beyond as it stands.
/// @param void_fraction e  @param grain_diameter d, m: Sauter mean of the grains, not of the parcels
/// @param viscosity Pa s  @param density of the gas, kg/m3  @param superficial_speed m/s
/// @return kg/m3/s
inline double beetstra_resistance(double void_fraction, double grain_diameter, double viscosity, double density,
                                  double superficial_speed) {
  const double solids = 1 - void_fraction;
  const double void_squared = void_fraction * void_fraction;
  const double reynolds = density * superficial_speed * grain_diameter / viscosity;
  double drag = 10 * solids / void_squared + void_squared * (1 + 1.5 * std::sqrt(solids));
  if (reynolds > 0) {
    drag += 0.413 * reynolds / (24 * void_squared) *
            (1 / void_fraction + 3 * solids * void_fraction + 8.4 * std::pow(reynolds, -0.343)) /
            (1 + std::pow(10.0, 3 * solids) * std::pow(reynolds, -(1 + 4 * solids) / 2));
  }
  return 18 * viscosity * solids * drag / (void_fraction * grain_diameter * grain_diameter);
}

/// Drag of one grain of a mixture over the drag 3 pi mu d_i U F of the mean grain's law (same paper, after van der
/// Hoef, Beetstra and Kuipers 2005): y + 0.064 y^3, y = d_i/d_S, d_S the Sauter mean diameter.
inline double beetstra_grain_polydispersity(double size_ratio) {
  return size_ratio * (1 + 0.064 * size_ratio * size_ratio);
}

/// Factor of a mixed bed on the resistance at its Sauter mean diameter: the sum of `beetstra_grain_polydispersity` over
/// the grains,
///   (1 + 0.064 <y>)/1.064,  <y> = (volume-weighted mean of d_i)/d_S >= 1.
/// The published sum is divided by its value for grains of one size, so that a bed of one size gets exactly the law
/// itself and the factor is continuous from layer to layer.  `beetstra_polydispersity(1) == 1`.
/// @param mean_size_ratio <y>
inline double beetstra_polydispersity(double mean_size_ratio) {
  return (1 + 0.064 * std::max(1.0, mean_size_ratio)) / 1.064;
}

}  // namespace cupola
