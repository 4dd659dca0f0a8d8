#include "physics/closures/inlet.hpp"

#include <cmath>

#include "physics/closures/gas_properties.hpp"

namespace cupola {

InletState inlet_state(double mass_flow, double total_temperature, double opening, double static_pressure,
                       double molar_mass, double heat_capacity) {
  const double ratio = heat_capacity_ratio(heat_capacity, molar_mass);
  const double specific_gas_constant = molar_gas_constant / molar_mass;
  // Ma sqrt(1 + (g-1)/2 Ma^2)
  const double flow_number =
      mass_flow / opening * std::sqrt(specific_gas_constant * total_temperature / ratio) / static_pressure;
  const double squared = flow_number * flow_number;
  // The stable form of (-1 + sqrt(1 + 2 (g-1) K^2))/(g-1).
  const double mach_squared = 2 * squared / (1 + std::sqrt(1 + 2 * (ratio - 1) * squared));
  const double total_over_static = 1 + (ratio - 1) / 2 * mach_squared;

  InletState state;
  state.mach_number = std::sqrt(mach_squared);
  state.static_temperature = total_temperature / total_over_static;
  state.static_pressure = static_pressure;
  state.total_pressure = static_pressure * std::pow(total_over_static, ratio / (ratio - 1));
  state.density = gas_density(static_pressure, state.static_temperature, molar_mass);
  state.velocity = state.mach_number * std::sqrt(ratio * specific_gas_constant * state.static_temperature);
  return state;
}

double smallest_opening(double mass_flow, double total_temperature, double static_pressure, double molar_mass,
                        double heat_capacity, double mach_number) {
  const double ratio = heat_capacity_ratio(heat_capacity, molar_mass);
  const double flow_number = mach_number * std::sqrt(1 + (ratio - 1) / 2 * mach_number * mach_number);
  return mass_flow * std::sqrt(molar_gas_constant / molar_mass * total_temperature / ratio) /
         (static_pressure * flow_number);
}

}  // namespace cupola
