#pragma once
#include <algorithm>

#include "schemas/campaign.hpp"

namespace cupola {

/// Largest random packing of equal spheres; a fully softened grain fills the volume it occupied at this packing.
inline constexpr double largest_random_packing = 0.64;

/// Degree of softening: 0 up to `softening.from`, 1 from `softening.melted`, linear between.
inline double softening_degree(double temperature, const Softening& softening) {
  return std::clamp((temperature - softening.from) / (softening.melted - softening.from), 0.0, 1.0);
}

/// Pseudo-volume factor f_eff of a softening grain (paper eq. 6): mass = 4/3 pi r^3 rho f_eff with the contact radius
/// r,
///   f_eff = 1 + degree (1/0.64 - 1), from 1 to 1.5625.
/// @param temperature K
inline double volume_factor(double temperature, const Softening& softening) {
  return 1 + softening_degree(temperature, softening) * (1 / largest_random_packing - 1);
}

}  // namespace cupola
