#pragma once
#include <cmath>

#include "schemas/campaign.hpp"

namespace cupola {

/// Viscosity of a gas after Sutherland (1893), Pa s:  mu = mu_0 (T/T_0)^(3/2) (T_0 + S)/(T + S).
/// Range: dilute gases, about 170 to 1900 K within 2 to 4 % (White, Viscous Fluid Flow, table 1-2); used beyond.
inline double viscosity_sutherland(const Sutherland& law, double temperature) {
  const double ratio = temperature / law.at;
  return law.viscosity * ratio * std::sqrt(ratio) * (law.at + law.constant) / (temperature + law.constant);
}

/// Viscosity of the campaign's gas, Pa s.
inline double gas_viscosity(const Gas& gas, double temperature) {
  return gas.viscosity_model == Gas::ViscosityModel::constant ? gas.viscosity
                                                              : viscosity_sutherland(gas.sutherland, temperature);
}

}  // namespace cupola
