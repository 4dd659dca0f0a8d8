#pragma once
#include <cmath>

namespace cupola {

/// Drag of coarse parcels on coarse cells over the drag law's own (seed 002, after Radl and co-workers):
///   beta_parcel/beta = c_corr(n) (1 - f(F) h(a)),  c_corr = exp(-k (n - 1)), n the coarse graining.
/// k comes from the sedimentation of the grains in question as parcels (0: no correction).  The seed does not print f
/// and h; they are those of Igci and Sundaresan (Ind. Eng. Chem. Res. 50, 2011, 13190; AIChE J. 57, 2011, 2691) for
/// clusters smaller than a cell,
///   f = F^1.6/(F^1.6 + 0.4),  F = g D/v_t^2,  D = cube root of the cell's volume,  v_t = g d^2 rho_p/(18 mu),
/// and h the product of the two functions of the solids fraction a below.
/// Range: grains in the Stokes regime (75 um, 1500 kg/m3 in air); for grains of millimetres F is so small that nothing
/// is corrected, and packed beds (a > 0.59) never are.

/// c_corr.  @param coefficient k  @param coarse_graining n
inline double parcel_drag_correction(double coefficient, double coarse_graining) {
  return std::exp(-coefficient * (coarse_graining - 1));
}

/// F.  @param cell_size D, m  @param grain_diameter d, m  @param grain_density rho_p, kg/m3 (the gas's is neglected
/// beside it)  @param viscosity mu of the gas, Pa s
inline double filter_size(double cell_size, double grain_diameter, double grain_density, double viscosity) {
  constexpr double gravity = 9.81;
  const double settling = gravity * grain_diameter * grain_diameter * grain_density / (18 * viscosity);
  return gravity * cell_size / (settling * settling);
}

/// f, in [0, 1).
inline double filter_size_function(double filter_size) {
  const double power = std::pow(filter_size, 1.6);
  return power / (power + 0.4);
}

/// h(a): 0 for a cell without solids and from a = 0.59 on.
inline double filter_solids_function(double solids_fraction) {
  const double a = solids_fraction;
  double h = 0;
  if (a <= 0 || a > 0.59) return 0;
  if (a < 0.0012) {
    h = 2.7 * std::pow(a, 0.234);
  } else if (a < 0.014) {
    h = -0.019 * std::pow(a, -0.455) + 0.963;
  } else if (a < 0.25) {
    h = 0.868 * std::exp(-0.38 * a) - 0.176 * std::exp(-119.2 * a);
  } else if (a < 0.455) {
    h = -4.59e-5 * std::exp(19.75 * a) + 0.852 * std::exp(-0.268 * a);
  } else {
    h = (a - 0.59) * (((-1501 * a + 2203) * a - 1054) * a + 162);
  }
  return a < 0.18 ? h * std::pow(a, 0.24) * (1.48 + std::exp(-18 * a)) : h;
}

/// 1 - f h.
inline double grid_drag_correction(double filter_size, double solids_fraction) {
  return 1 - filter_size_function(filter_size) * filter_solids_function(solids_fraction);
}

}  // namespace cupola
