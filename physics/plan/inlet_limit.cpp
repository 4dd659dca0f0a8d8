#include "physics/plan/inlet_limit.hpp"

#include <fmt/format.h>

#include <cmath>

#include "physics/closures/gas_state.hpp"

namespace cupola {

std::string inlet_refusal(const Gas& gas, const Inlet& inlet, const InletState& state) {
  if (!state.choked() && state.mach_number <= mach_to_refuse) return {};
  const double smallest = smallest_opening(inlet.mass_flow, inlet.total_temperature, state.static_pressure,
                                           gas.molar_mass, GasState(gas).heat_capacity(inlet.total_temperature));
  return fmt::format(
      "scene.gas.inlets: {} kg/s at {} K through the {:.4g} m2 of '{}' {} (limit {}); the smallest opening that works "
      "is {:.3g} m2, for example [{:.3g} m, {:.3g} m]",
      inlet.mass_flow, inlet.total_temperature, inlet.mass_flow / (state.density * state.velocity), inlet.name,
      state.choked() ? "chokes: it would need more than Mach 1" : fmt::format("needs Mach {:.2f}", state.mach_number),
      mach_to_refuse, smallest, std::sqrt(smallest), std::sqrt(smallest));
}

}  // namespace cupola
