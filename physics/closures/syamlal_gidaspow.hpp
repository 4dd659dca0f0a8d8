#pragma once
#include <cmath>

namespace cupola {

/// Conductivity of the gas in a bed after Syamlal and Gidaspow (1985), per area of bed:
///   e k_eff = (1 - sqrt(1 - e)) k_f,  with their k_eff = (1 - sqrt(1 - e))/e k_f per area of gas.
/// The gas energy equation (paper eq. 11) has div(alpha_f k_eff grad T), so this product stands in front of its grad T
/// and must not be multiplied by the void fraction again.  The paper's own code has the same product.
/// @param void_fraction e in [0, 1]  @param gas_conductivity k_f, W/m/K  @return W/m/K; k_f without solids, 0 without
/// gas
inline double gas_conductivity_syamlal_gidaspow(double void_fraction, double gas_conductivity) {
  return (1 - std::sqrt(1 - void_fraction)) * gas_conductivity;
}

}  // namespace cupola
