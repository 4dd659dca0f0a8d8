#pragma once

namespace cupola {

/// Heat exchanged by conduction between alternating flat layers of two species, per bed volume and difference of their
/// mean temperatures, W/m3/K:
///   12 / ((a + b) (a/k_a + b/k_b)).
/// With uniform heating and no flux at a layer's middle its temperature is a parabola, so mean - face = q a/(6 k) for a
/// flux q through the face.  Both sides of a face give q = 6 (T_a - T_b)/(a/k_a + b/k_b), and there are two faces a
/// period a + b. No fitted constant.  Range: changes slow against a^2 k/(rho c); 0 where a layer does not conduct.
/// @param thickness_a, thickness_b m, > 0  @param conductivity_a, conductivity_b of the beds
/// (`bed_conductivity_carson`), W/m/K
inline double layer_exchange(double thickness_a, double conductivity_a, double thickness_b, double conductivity_b) {
  if (conductivity_a <= 0 || conductivity_b <= 0) return 0;
  return 12 / ((thickness_a + thickness_b) * (thickness_a / conductivity_a + thickness_b / conductivity_b));
}

}  // namespace cupola
