#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "physics/gas/bed_gas.hpp"
#include "schemas/failure.hpp"
#include "tests/support/foam_scene.hpp"
#include "tests/support/furnaces.hpp"

namespace cupola {
namespace {

constexpr double inlet_temperature = 2600;
constexpr double solids_temperature = 500;

/// The box blown from below with a gas that does not conduct: a one-dimensional exchanger.
Campaign exchanger(double cell) {
  Campaign campaign = furnaces::box();
  campaign.scene.mesh.cell = cell;
  campaign.scene.gas->prandtl = 1e12;
  campaign.scene.gas->inlets[0].total_temperature = inlet_temperature;
  return campaign;
}

/// Solids with `transfer_units` in the whole bed, whose temperature rises by `slope` (K/m) above that of the bottom.
SolidsExchange solids(const BedMesh& mesh, const Campaign& campaign, double transfer_units, double slope = 0) {
  const auto& gas = *campaign.scene.gas;
  const double whole = transfer_units * gas.inlets[0].mass_flow * gas.heat_capacity;
  double volume = 0;
  for (const double v : mesh.cell_volume) volume += v;
  SolidsExchange exchange;
  for (std::size_t cell = 0; cell < mesh.cells(); ++cell) {
    const double conductance = whole * mesh.cell_volume[cell] / volume;
    exchange.conductance.push_back(conductance);
    exchange.conductance_temperature.push_back(conductance * (solids_temperature + slope * mesh.cell_centre[cell][2]));
  }
  return exchange;
}

double top_temperature(double cell, double transfer_units, double slope = 0) {
  const Campaign campaign = exchanger(cell);
  FoamScene scene(campaign);
  DarcyForchheimer flow(scene.foam, scene.mesh, campaign);
  GasEnergy energy(scene.foam, scene.mesh, campaign);
  const auto bed = uniform_bed(scene.mesh, 0.42, 0.03);
  flow.solve(bed, energy.temperature(), 1e-9, 50);
  energy.solve(flow, bed, solids(scene.mesh, campaign, transfer_units, slope));
  EXPECT_LT(std::abs(energy.ledger().residual), 1e-10);
  return energy.ledger().top_gas_temperature;
}

TEST(GasEnergy, ExchangeWithSolidsOfOneTemperatureIsTheExactExponentialOnAnyMesh) {
  for (const double units : {0.01, 1.5, 40.0}) {
    const double exact = solids_temperature + (inlet_temperature - solids_temperature) * std::exp(-units);
    for (const int rows : {15, 30}) EXPECT_NEAR(top_temperature(1.5 / rows, units), exact, 1e-6) << units;
  }
}

TEST(GasEnergy, ExchangeWithSolidsThatVaryIsSecondOrder) {
  // dT/dY = a + b Y - T over Y in [0, units].
  const double units = 6;
  const double slope = -300;
  const double b = slope * 1.5 / units;
  const double exact =
      solids_temperature + b * units - b + (inlet_temperature - solids_temperature + b) * std::exp(-units);
  const double coarse = std::abs(top_temperature(1.5 / 15, units, slope) - exact);
  const double fine = std::abs(top_temperature(1.5 / 30, units, slope) - exact);
  EXPECT_LT(coarse, 2);
  EXPECT_GT(std::log2(coarse / fine), 1.9);
}

TEST(GasEnergy, ManyTransferUnitsACellLeaveTheGasWithTheSolids) {
  for (const double units : {1e3, 1e6, 1e12}) {
    EXPECT_NEAR(top_temperature(0.1, units), solids_temperature, 1e-6) << units;
  }
}

TEST(GasEnergy, WallLossIsExactAndInTheLedger) {
  Campaign campaign = exchanger(0.1);
  // One cell from wall to wall on either side of the middle.
  campaign.scene.geometry.profile = {{0, 0.1}, {1.5, 0.1}};
  campaign.scene.geometry.sides = Geometry::Sides::periodic;
  campaign.species[0].coarse_graining = campaign.species[1].coarse_graining = 1;
  campaign.scene.heat_loss = WallHeatLoss{200, 300};
  FoamScene scene(campaign);
  DarcyForchheimer flow(scene.foam, scene.mesh, campaign);
  GasEnergy energy(scene.foam, scene.mesh, campaign);
  const auto bed = uniform_bed(scene.mesh, 0.42, 0.03);
  flow.solve(bed, energy.temperature(), 1e-9, 50);
  energy.solve(flow, bed, solids(scene.mesh, campaign, 0));
  const auto& gas = *campaign.scene.gas;
  const double per_row = 200 * 2 * 0.4 * 0.1 / (gas.inlets[0].mass_flow * gas.heat_capacity);
  EXPECT_NEAR(energy.ledger().top_gas_temperature, 300 + (inlet_temperature - 300) * std::exp(-15 * per_row), 1e-6);
  EXPECT_GT(energy.ledger().walls, 0.05 * energy.ledger().blast);
  EXPECT_EQ(energy.ledger().to_solids, 0);
  EXPECT_LT(std::abs(energy.ledger().residual), 1e-10);
}

TEST(GasEnergy, ConductionAloneReachesStagnantCells) {
  // A closed pocket, here a bed so tight above the bottom's left half that nothing flows through it, is still solved.
  Campaign campaign = furnaces::box();
  campaign.scene.gas->inlets[0].total_temperature = inlet_temperature;
  FoamScene scene(campaign);
  DarcyForchheimer flow(scene.foam, scene.mesh, campaign);
  GasEnergy energy(scene.foam, scene.mesh, campaign);
  auto bed = uniform_bed(scene.mesh, 0.42, 0.03);
  for (std::size_t cell = 0; cell < scene.mesh.cells(); ++cell) {
    if (scene.mesh.cell_centre[cell][0] < -0.1 && scene.mesh.cell_centre[cell][2] > 0.3)
      bed.grain_diameter[cell] = 1e-6;
  }
  flow.solve(bed, energy.temperature(), 1e-6, 50);
  const auto& temperature = energy.solve(flow, bed, solids(scene.mesh, campaign, 0));
  for (const double t : temperature) EXPECT_NEAR(t, inlet_temperature, 1e-4);
}

TEST(GasEnergy, StaysBetweenBlastAndSolidsInAFurnace) {
  Campaign campaign = furnaces::shaft();
  campaign.scene.heat_loss = WallHeatLoss{20, 293};
  FoamScene scene(campaign);
  DarcyForchheimer flow(scene.foam, scene.mesh, campaign);
  GasEnergy energy(scene.foam, scene.mesh, campaign);
  auto bed = uniform_bed(scene.mesh, 0.42, 0.03);
  SolidsExchange exchange;
  for (std::size_t cell = 0; cell < scene.mesh.cells(); ++cell) {
    const bool freeboard = scene.mesh.cell_centre[cell][2] > 6.1;
    if (freeboard) bed.void_fraction[cell] = 1;
    const double conductance = freeboard ? 0 : 800 * scene.mesh.cell_volume[cell];
    exchange.conductance.push_back(conductance);
    exchange.conductance_temperature.push_back(conductance * (400 + 200 * std::sin(scene.mesh.cell_centre[cell][2])));
  }
  // Flow and temperature depend on each other: a few turns.
  for (int turn = 0; turn < 6; ++turn) {
    flow.solve(bed, energy.temperature(), 1e-4, 20);
    energy.solve(flow, bed, exchange);
    EXPECT_LT(std::abs(energy.ledger().residual), 1e-10);
  }
  const auto& temperature = energy.temperature();
  EXPECT_GT(*std::min_element(temperature.begin(), temperature.end()), 200);
  EXPECT_LE(*std::max_element(temperature.begin(), temperature.end()), inlet_temperature);
  const auto& ledger = energy.ledger();
  EXPECT_NEAR(ledger.blast, 2.8 * campaign.scene.gas->heat_capacity * (inlet_temperature - 293), 1e-9 * ledger.blast);
  EXPECT_GT(ledger.to_solids, 0.5 * ledger.blast);
  EXPECT_GT(ledger.walls, 0);
}

TEST(GasEnergy, ACellWithoutGasIsNamed) {
  const Campaign campaign = exchanger(0.1);
  FoamScene scene(campaign);
  DarcyForchheimer flow(scene.foam, scene.mesh, campaign);
  GasEnergy energy(scene.foam, scene.mesh, campaign);
  auto bed = uniform_bed(scene.mesh, 0.42, 0.03);
  flow.solve(bed, energy.temperature(), 1e-6, 50);
  bed.void_fraction[3] = 0;
  try {
    energy.solve(flow, bed, solids(scene.mesh, campaign, 1));
    FAIL();
  } catch (const Failure& failure) {
    EXPECT_EQ(failure.code(), ExitCode::diverged);
    EXPECT_EQ(failure.where().at("cell"), "3");
  }
}

}  // namespace
}  // namespace cupola
