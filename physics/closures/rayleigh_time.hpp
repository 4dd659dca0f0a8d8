#pragma once
#include <cmath>
#include <numbers>

namespace cupola {

/// Rayleigh time of a sphere, s: pi R sqrt(rho/G)/(0.1631 nu + 0.8766), G = E/(2 (1 + nu)).
/// Explicit time steps of Hertz contacts are quoted as a fraction of the smallest one in the scene.  A parcel has its
/// own radius and the density and modulus of the material.
/// @param radius m  @param density kg/m3  @param youngs_modulus Pa  @param poisson_ratio in [0, 0.5]
inline double rayleigh_time(double radius, double density, double youngs_modulus, double poisson_ratio) {
  const double shear_modulus = youngs_modulus / (2 * (1 + poisson_ratio));
  return std::numbers::pi * radius * std::sqrt(density / shear_modulus) / (0.1631 * poisson_ratio + 0.8766);
}

}  // namespace cupola
