#include <gtest/gtest.h>

#include <cmath>

#include "physics/closures/drag.hpp"
#include "physics/closures/gas_state.hpp"
#include "physics/gas/bed_gas.hpp"
#include "physics/gas/gas_thermodynamics.hpp"
#include "schemas/gas_presets.hpp"
#include "tests/support/foam_scene.hpp"
#include "tests/support/furnaces.hpp"

namespace cupola {
namespace {

/// The box's column blown with nitrogen whose properties change with the temperature.
Campaign hot_nitrogen() {
  Campaign campaign = furnaces::box();
  Gas& gas = *campaign.scene.gas;
  for (const auto& preset : gas_presets()) {
    if (preset.name != "nitrogen") continue;
    gas.molar_mass = preset.molar_mass;
    gas.sutherland = preset.sutherland;
    gas.janaf = preset.janaf;
  }
  gas.viscosity_model = Gas::ViscosityModel::sutherland;
  gas.heat_capacity_model = Gas::HeatCapacityModel::janaf;
  gas.inlets[0].total_temperature = 2300;
  campaign.heat.emplace();
  return campaign;
}

TEST(GasThermodynamics, OpenFoamAndTheClosureAgree) {
  const Campaign campaign = hot_nitrogen();
  const GasThermodynamics foam(*campaign.scene.gas);
  const GasState closure(*campaign.scene.gas);
  for (const double t : {150.0, 293.0, 600.0, 999.0, 1001.0, 2600.0, 6500.0}) {
    // OpenFOAM's molar gas constant differs in the sixth digit.
    EXPECT_NEAR(foam.heat_capacity(t), closure.heat_capacity(t), 3e-6 * closure.heat_capacity(t)) << t;
    EXPECT_NEAR(foam.enthalpy(t), closure.enthalpy(t), 3e-6 * std::abs(closure.enthalpy(t)) + 1e-3) << t;
  }
}

TEST(GasEnergyOverTemperature, GasGivesTheDifferenceOfItsEnthalpies) {
  const Campaign campaign = hot_nitrogen();
  FoamScene scene(campaign);
  DarcyForchheimer flow(scene.foam, scene.mesh, campaign);
  GasEnergy energy(scene.foam, scene.mesh, campaign);
  const auto bed = uniform_bed(scene.mesh, 0.42, 0.03);
  flow.solve(bed, energy.temperature(), 1e-9, 50);
  // So much exchange that the gas leaves with the solids' 700 K.
  SolidsExchange solids{std::vector<double>(scene.mesh.cells(), 1e5), std::vector<double>(scene.mesh.cells(), 7e7)};
  energy.solve(flow, bed, solids);
  const GasThermodynamics gas(*campaign.scene.gas);
  const auto& ledger = energy.ledger();
  EXPECT_NEAR(ledger.top_gas_temperature, 700, 1e-3);
  EXPECT_NEAR(ledger.to_solids, 0.1 * (gas.enthalpy(2300) - gas.enthalpy(700)), 1e-6 * ledger.blast);
  EXPECT_LT(std::abs(ledger.residual), 1e-10);
  // With the blast's own heat capacity it would be another heat.
  EXPECT_GT(std::abs(0.1 * gas.heat_capacity(2300) * 1600 - ledger.to_solids), 0.02 * ledger.to_solids);
}

TEST(GasEnergyOverTemperature, FiniteExchangeFollowsTheEquationOfThePlugFlow) {
  Campaign campaign = hot_nitrogen();
  campaign.scene.mesh.cell = 0.05;
  FoamScene scene(campaign);
  DarcyForchheimer flow(scene.foam, scene.mesh, campaign);
  GasEnergy energy(scene.foam, scene.mesh, campaign);
  const auto bed = uniform_bed(scene.mesh, 0.42, 0.03);
  flow.solve(bed, energy.temperature(), 1e-9, 50);
  const double whole = 200, solids_temperature = 500;  // W/K in all
  SolidsExchange solids;
  double volume = 0;
  for (const double v : scene.mesh.cell_volume) volume += v;
  for (const double v : scene.mesh.cell_volume) {
    solids.conductance.push_back(whole * v / volume);
    solids.conductance_temperature.push_back(whole * v / volume * solids_temperature);
  }
  for (int turn = 0; turn < 4; ++turn) energy.solve(flow, bed, solids);
  // m cp(T) dT = -hA (T - T_s) dx, by small steps.
  const GasThermodynamics gas(*campaign.scene.gas);
  double temperature = 2300;
  constexpr int steps = 100000;
  for (int i = 0; i < steps; ++i) {
    const double slope = -whole * (temperature - solids_temperature) / (0.1 * gas.heat_capacity(temperature));
    temperature += slope / steps;
  }
  EXPECT_NEAR(energy.ledger().top_gas_temperature, temperature, 2e-3 * (2300 - temperature));
  EXPECT_LT(std::abs(energy.ledger().residual), 1e-10);
}

TEST(SutherlandFlow, ColumnIsExactWithTheViscosityOfItsTemperature) {
  const Campaign campaign = hot_nitrogen();
  FoamScene scene(campaign);
  DarcyForchheimer flow(scene.foam, scene.mesh, campaign);
  flow.solve(uniform_bed(scene.mesh, 0.42, 2e-3), std::vector<double>(scene.mesh.cells(), 1500), 1e-9, 50);
  const Gas& gas = *campaign.scene.gas;
  const double flux = 0.1 / 0.24;
  const double resistance = drag_resistance(campaign.drag, 0.42, 2e-3, gas_viscosity(gas, 1500), 1, flux);
  const double squared = gas.outlet_pressure * gas.outlet_pressure +
                         2 * molar_gas_constant / gas.molar_mass * 1500 * resistance * flux * 1.5;
  EXPECT_NEAR(flow.inlets()[0].state.static_pressure, std::sqrt(squared), 1e-8 * gas.outlet_pressure);
}

}  // namespace
}  // namespace cupola
