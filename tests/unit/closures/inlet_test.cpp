#include "physics/closures/inlet.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "physics/closures/gas_properties.hpp"

namespace cupola {
namespace {

constexpr double molar_mass = 0.028;
const double heat_capacity = 745 + molar_gas_constant / molar_mass;

TEST(Inlet, MassAndTotalEnthalpyAreThoseGiven) {
  const InletState state = inlet_state(1.4, 2600, 0.0625, 1.05e5, molar_mass, heat_capacity);
  EXPECT_NEAR(state.density * state.velocity * 0.0625, 1.4, 1e-12);
  EXPECT_NEAR(heat_capacity * state.static_temperature + state.velocity * state.velocity / 2, heat_capacity * 2600,
              1e-6);
  EXPECT_FALSE(state.choked());
}

TEST(Inlet, SlowGasIsIncompressible) {
  const InletState state = inlet_state(1e-4, 300, 0.1, 1e5, molar_mass, heat_capacity);
  EXPECT_NEAR(state.velocity, 1e-3 / gas_density(1e5, 300, molar_mass), 1e-9);
  EXPECT_NEAR(state.total_pressure, 1e5, 1e-3);
  EXPECT_EQ(inlet_state(0, 300, 0.1, 1e5, molar_mass, heat_capacity).velocity, 0);
}

TEST(Inlet, TuyereOfThePaper) {
  // Two openings of 0.25 m x 0.25 m at 200 m/s and 2600 K carry about 1.66 kg/s each at 1.03 bar (reference cases).
  const InletState state =
      inlet_state(1.66, 2600 + 200 * 200 / (2 * heat_capacity), 0.0625, 1.03e5, molar_mass, heat_capacity);
  EXPECT_NEAR(state.velocity, 200, 1);
  EXPECT_NEAR(state.static_temperature, 2600, 1);
}

TEST(Inlet, SonicFlowIsTheChokedMassFlow) {
  // p*/p0 and the choked mass flux of an ideal gas, textbook form.
  const double g = heat_capacity_ratio(heat_capacity, molar_mass), total_temperature = 1500, total_pressure = 3e5;
  const double flux = total_pressure * std::sqrt(g * molar_mass / (molar_gas_constant * total_temperature)) *
                      std::pow(2 / (g + 1), (g + 1) / (2 * (g - 1)));
  const double throat_pressure = total_pressure * std::pow(2 / (g + 1), g / (g - 1));
  const InletState state = inlet_state(flux, total_temperature, 1, throat_pressure, molar_mass, heat_capacity);
  EXPECT_NEAR(state.mach_number, 1, 1e-12);
  EXPECT_NEAR(state.total_pressure, total_pressure, 1e-6);
  EXPECT_TRUE(inlet_state(1.01 * flux, total_temperature, 1, throat_pressure, molar_mass, heat_capacity).choked());
}

TEST(Inlet, SmallestOpeningGivesTheMachNumberAskedFor) {
  for (const double mach : {0.1, 0.3, 0.8}) {
    const double opening = smallest_opening(8.6, 2620, 1.2e5, molar_mass, heat_capacity, mach);
    EXPECT_NEAR(inlet_state(8.6, 2620, opening, 1.2e5, molar_mass, heat_capacity).mach_number, mach, 1e-12);
  }
}

}  // namespace
}  // namespace cupola
