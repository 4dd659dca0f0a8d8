#pragma once

namespace cupola {

/// Molar gas constant, J/mol/K (exact, SI 2019).
inline constexpr double molar_gas_constant = 8.31446261815324;

/// Density of an ideal gas, kg/m3: p M/(R T).
/// @param pressure Pa  @param temperature K  @param molar_mass kg/mol
inline double gas_density(double pressure, double temperature, double molar_mass) {
  return pressure * molar_mass / (molar_gas_constant * temperature);
}

/// Conductivity of a gas from its Prandtl number, W/m/K: mu cp/Pr.
/// @param viscosity Pa s  @param heat_capacity at constant pressure, J/kg/K
inline double gas_conductivity(double viscosity, double heat_capacity, double prandtl) {
  return viscosity * heat_capacity / prandtl;
}

/// Ratio of the heat capacities of an ideal gas, cp/(cp - R/M).
/// @param heat_capacity at constant pressure, J/kg/K, more than R/M  @param molar_mass kg/mol
inline double heat_capacity_ratio(double heat_capacity, double molar_mass) {
  return heat_capacity / (heat_capacity - molar_gas_constant / molar_mass);
}

}  // namespace cupola
