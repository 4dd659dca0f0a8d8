#include <gtest/gtest.h>

#include <cstdio>

#include "tests/support/tracer_program.hpp"
#include "tests/verification/tracer/column.hpp"

namespace cupola {
namespace {

constexpr double outlet_pressure = 1e5;

/// Bed of the reference: grains of 1 mm, void fraction 0.451335, 15.6 mm high; gas of 10 kg/m3 and 1.5e-4 m2/s.
Campaign reference_bed(double speed) {
  Campaign campaign = testing::column_campaign(6);
  campaign.heat.reset();
  campaign.drag = DragLaw::ergun;
  campaign.scene.geometry.profile = {{0, 0.005}, {0.0156, 0.005}};
  campaign.scene.geometry.depth = 0.01;
  campaign.charging.stock_line = 0.0156;
  campaign.charging.layers = {{{"pebble", 5e-4}}};
  Gas& gas = *campaign.scene.gas;
  gas.molar_mass = 10 * 8.314462618 * 293 / outlet_pressure;
  gas.viscosity = 10 * 1.5e-4;
  gas.outlet_pressure = outlet_pressure;
  gas.inlets[0].mass_flow = 10 * speed * 0.01 * 0.01;
  gas.inlets[0].total_temperature = 293;
  campaign.species[0].diameter = 1e-3;
  campaign.tracer.duration = 1;
  return campaign;
}

testing::StatedBed reference_packing(const BedMesh& mesh, const Campaign& campaign) {
  return testing::bed_at_rest(mesh, campaign, 1 - 0.451335);
}

double pressure_drop(const testing::TracerProgram& program) {
  return program.result().summary()["inlets"][0]["pressure"].get<double>() - outlet_pressure;
}

class EveryGasModel : public ::testing::TestWithParam<TracerSettings::GasModel> {};

TEST_P(EveryGasModel, PressureDropOfTheReferenceBed) {
  testing::TracerProgram program(reference_bed(1e-3), reference_packing);
  for (const auto& [speed, drop] : {std::pair{2e-3, 22.992}, {10e-3, 115.09}, {20e-3, 230.51}}) {
    Campaign campaign = reference_bed(speed);
    campaign.tracer.gas = GetParam();
    program.march_anew(campaign);
    ASSERT_EQ(program.run(), 0) << program.failure();
    // The reference is of constant density, at the outlet's pressure; ours falls along the bed by drop/p.
    const double found = pressure_drop(program);
    const double constant_density = (std::pow(outlet_pressure + found, 2) - std::pow(outlet_pressure, 2)) / 2 / 1e5;
    std::printf("%g m/s: %.4f Pa (%.4f at constant density), reference %.4f\n", speed, found, constant_density, drop);
    EXPECT_NEAR(constant_density, drop, 2e-4 * drop);
  }
}

constexpr double hot = 1200;
constexpr double cold = 400;
constexpr double solids_fraction = 0.55;

/// A column of small pebbles, the lower half hot and the upper half cold: gas has the solids' temperature within
/// millimetres, so that its density jumps by three in the middle.
TEST_P(EveryGasModel, HotAndColdHalvesOfAColumn) {
  Campaign campaign = testing::column_campaign(40);
  campaign.drag = DragLaw::ergun;
  campaign.species[0].diameter = 1e-3;
  campaign.scene.gas->inlets[0].total_temperature = hot;
  campaign.scene.gas->outlet_pressure = outlet_pressure;
  campaign.initial.cohesive_zone = InvertedV{0.5, 0, hot, cold};
  campaign.tracer.gas = GetParam();
  campaign.tracer.time_step = 1e-3;
  campaign.tracer.duration = 1e-3;  // the solids keep their temperature
  const testing::TracerProgram program(
      campaign, [](const BedMesh& mesh, const Campaign& c) { return testing::bed_at_rest(mesh, c, solids_fraction); });
  ASSERT_EQ(program.run(), 0) << program.failure();
  // Ergun's resistance to the mass flux times 1/density: p dp = -(R T/M)(150 mu a^2/(e^3 d^2) + 1.75 |G| a/(e^3 d)) G
  // dz.
  const double void_fraction = 1 - solids_fraction;
  const double diameter = campaign.species[0].diameter;
  const double flux = testing::blast_flux(campaign);
  const double cube = std::pow(void_fraction, 3);
  const double resistance =
      150 * campaign.scene.gas->viscosity * std::pow(solids_fraction, 2) / (cube * diameter * diameter) +
      1.75 * flux * solids_fraction / (cube * diameter);
  const auto squares = [&](double temperature) {
    return 2 * 8.314462618 * temperature / campaign.scene.gas->molar_mass * resistance * flux * 0.5;
  };
  const double middle = std::sqrt(outlet_pressure * outlet_pressure + squares(cold));
  const double inlet = std::sqrt(middle * middle + squares(hot));
  const double found = pressure_drop(program);
  const auto rows = testing::row_means(program.mesh(), program.result().cell_data("gas_pressure"), 1, 40);
  const double at_middle = std::sqrt(0.5 * (rows[19] * rows[19] + rows[20] * rows[20]));
  std::printf("drop %.2f Pa, exact %.2f; upper half %.2f, exact %.2f\n", found, inlet - outlet_pressure,
              at_middle - outlet_pressure, middle - outlet_pressure);
  EXPECT_NEAR(found, inlet - outlet_pressure, 5e-3 * (inlet - outlet_pressure));
  // Between the two rows the gas cools, so the mean of their squares lies a little beside the pressure there.
  const double quarter = (squares(hot) - squares(cold)) / 40 / 4 / middle;
  EXPECT_NEAR(at_middle, middle + quarter, 5e-3 * (inlet - outlet_pressure));
}

INSTANTIATE_TEST_SUITE_P(
    Ergun, EveryGasModel,
    ::testing::Values(TracerSettings::GasModel::darcy_forchheimer, TracerSettings::GasModel::navier_stokes),
    [](const auto& model) {
      return std::string(model.param == TracerSettings::GasModel::navier_stokes ? "NavierStokes" : "DarcyForchheimer");
    });

}  // namespace
}  // namespace cupola
