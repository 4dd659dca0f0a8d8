#pragma once
#include <cmath>
#include <numbers>

namespace cupola {

/// Reduced mass of two spheres, kg.
inline double reduced_mass(double mass_1, double mass_2) { return mass_1 * mass_2 / (mass_1 + mass_2); }

/// Stiffness of a pair of parcels with linear springs, N/m: a parcel's is its coarse graining times the grain's, and
/// two unequal springs count with their harmonic mean, 2 n1 n2/(n1 + n2) K.  So the overlap over the radius in a
/// collision at one speed does not depend on the coarse graining.
/// @param stiffness K of the grain, N/m
/// @param factor_1, factor_2 n of the two parcels
inline double parcel_pair_stiffness(double stiffness, double factor_1, double factor_2) {
  return 2 * factor_1 * factor_2 / (factor_1 + factor_2) * stiffness;
}

/// Duration of a head-on collision with a linear spring and dashpot, s: sqrt(pi^2 + ln^2 e) sqrt(m12/K).
/// @param reduced_mass m12, kg  @param stiffness K, N/m (of the parcels: coarse graining times the grain's)
/// @param restitution e in (0, 1]
inline double collision_time(double reduced_mass, double stiffness, double restitution) {
  return std::hypot(std::numbers::pi, std::log(restitution)) * std::sqrt(reduced_mass / stiffness);
}

/// Damping coefficient that gives the restitution: -2 m12 ln(e)/t, t the collision time; kg/s.
inline double collision_damping(double reduced_mass, double stiffness, double restitution) {
  return -2 * reduced_mass * std::log(restitution) / collision_time(reduced_mass, stiffness, restitution);
}

}  // namespace cupola
