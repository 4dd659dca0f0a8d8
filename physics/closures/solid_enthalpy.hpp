#pragma once
#include "physics/closures/enthalpy_zero.hpp"
#include "schemas/campaign.hpp"

namespace cupola {

/// Enthalpy of a solid, J/kg from 293 K: the integral of the heat capacity over the temperature, and the latent heat of
/// melting taken up evenly between the beginning of softening and the melting temperature,
///   h(T) = int_293^T cp dT + L min(1, max(0, (T - T_soft)/(T_melt - T_soft))).
/// (Apparent heat capacity: Voller and Swaminathan, Numer. Heat Transfer B 19 (1991) 175, with a linear liquid
/// fraction between solidus and liquidus.)  A species that does not soften has no latent heat.
/// @param temperature K
double solid_enthalpy(const Species& species, double temperature);

/// dh/dT of the above, J/kg/K; at the two temperatures that of the side above.
double apparent_heat_capacity(const Species& species, double temperature);

/// Whether the enthalpy is a straight line over the temperature.
inline bool has_constant_heat_capacity(const Species& species) {
  return species.heat_capacity.is_constant() && !(species.softening && species.softening->latent_heat > 0);
}

/// Temperature of a solid from its enthalpy: the exact inverse of `solid_enthalpy`.
/// @param enthalpy J/kg from 293 K  @return K
double solid_temperature(const Species& species, double enthalpy);

}  // namespace cupola
