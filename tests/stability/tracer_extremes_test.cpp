#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <iostream>

#include "schemas/campaign_reader.hpp"
#include "tests/support/tracer_run.hpp"

/// The tracer stage on stiff and extreme scenes: the tiny slot with one thing taken to its extreme a case.  Every case
/// must either end with closed balances and temperatures inside those of what comes in (the exchange has a maximum
/// principle: neither gas nor grain can leave the range of blast, charge, walls and first state), or be refused with a
/// sentence that names the limit.  Each prints a row of the table in docs/stability.md.
namespace cupola {
namespace {

struct Extreme {
  std::string name;  ///< of the test
  std::string what;  ///< column "what is extreme"
  std::function<void(Campaign&)> change;
  std::string refusal;  ///< where the program must refuse: part of its sentence; empty: must end well
};

Campaign tiny() {
  Campaign campaign = load_campaign(std::filesystem::path(CUPOLA_SOURCE_DIR) / "cases" / "tiny" / "campaign.yaml");
  campaign.tracer.duration = 300;
  return campaign;
}

void for_all(Campaign& campaign, const std::function<void(Species&)>& change) {
  for (Species& species : campaign.species) change(species);
}

void blast(Campaign& campaign, double mass_flow) {
  for (Inlet& inlet : campaign.scene.gas->inlets) inlet.mass_flow = mass_flow;
}

std::vector<Extreme> extremes() {
  return {
      {"NusseltFactorTiny", "Nusselt factor 0.001", [](Campaign& c) { c.heat->nusselt_factor = 1e-3; }, ""},
      {"NusseltFactorHuge", "Nusselt factor 1000", [](Campaign& c) { c.heat->nusselt_factor = 1e3; }, ""},
      {"ConductivityTiny", "conductivity of the grains 0.001 W/m/K",
       [](Campaign& c) { for_all(c, [](Species& s) { s.conductivity = 1e-3; }); }, ""},
      {"ConductivityHuge", "conductivity of the grains 10,000 W/m/K",
       [](Campaign& c) { for_all(c, [](Species& s) { s.conductivity = 1e4; }); }, ""},
      {"ConductivityContrast", "coke 0.001, ore 10,000 W/m/K",
       [](Campaign& c) {
         c.species[0].conductivity = 1e-3;
         c.species[1].conductivity = 1e4;
       },
       ""},
      {"GasHeatCapacityTiny", "heat capacity of the gas 1 % above the gas constant",
       [](Campaign& c) { c.scene.gas->heat_capacity = 1.01 * 8.314462618 / c.scene.gas->molar_mass; }, ""},
      {"GasHeatCapacityImpossible", "heat capacity of the gas 1 J/kg/K",
       [](Campaign& c) { c.scene.gas->heat_capacity = 1; }, "must exceed the gas constant"},
      {"GasHeatCapacityHuge", "heat capacity of the gas 100,000 J/kg/K",
       [](Campaign& c) { c.scene.gas->heat_capacity = 1e5; }, ""},
      {"SolidsHeatCapacityTiny", "heat capacity of the grains 0.01 J/kg/K",
       [](Campaign& c) { for_all(c, [](Species& s) { s.heat_capacity = 0.01; }); }, ""},
      {"SolidsHeatCapacityHuge", "heat capacity of the grains 10^8 J/kg/K",
       [](Campaign& c) { for_all(c, [](Species& s) { s.heat_capacity = 1e8; }); }, ""},
      {"ColdWallAtTheTuyere", "wall of 293 K and 10,000 W/m2/K beside a blast of 2600 K",
       [](Campaign& c) {
         c.scene.heat_loss->coefficient = 1e4;
         for (Inlet& inlet : c.scene.gas->inlets) inlet.total_temperature = 2600;
       },
       ""},
      {"WallWithoutResistance", "wall of 10^9 W/m2/K", [](Campaign& c) { c.scene.heat_loss->coefficient = 1e9; }, ""},
      {"BlastAlmostOff", "blast of 1 mg/s a tuyere", [](Campaign& c) { blast(c, 1e-6); }, ""},
      {"BlastDoubled", "blast doubled at once on the old bed", [](Campaign& c) { blast(c, 0.44); }, ""},
      {"BlastHuge", "blast of 50 kg/s a tuyere", [](Campaign& c) { blast(c, 50); }, ""},
      {"TuyeresTiny", "tuyeres of 15 x 15 mm",
       [](Campaign& c) {
         for (Inlet& inlet : c.scene.gas->inlets) inlet.size = {0.015, 0.015};
       },
       ""},
      {"NoGrainLeft", "no grain in the bed: all of the recipe is ore, and all of it has melted",
       [](Campaign& c) {
         c.initial.cohesive_zone = InvertedV{3.0, 0, 2400, 1700};
         c.species[0].softening = c.species[1].softening;
       },
       "holds no parcel"},
      {"AllOreMeltsAtOnce", "the whole bed guessed at the melting temperature, Nusselt factor 1000",
       [](Campaign& c) {
         c.initial.cohesive_zone->above = 1674.9;
         c.heat->nusselt_factor = 1000;
         c.species[1].none_below = 0;
       },
       ""},
      {"ZoneAtTheTop", "cohesive zone jumps to the stock line",
       [](Campaign& c) {
         c.initial.cohesive_zone = InvertedV{2.0, 0, 2400, 300};
       },
       ""},
      {"SofteningWithinAThousandth", "softening from 1674.999 to 1675 K",
       [](Campaign& c) { c.species[1].softening->from = 1674.999; }, ""},
      {"OneStep", "the whole stage in one step of 300 s", [](Campaign& c) { c.tracer.time_step = 300; }, ""},
      {"ManySteps", "3,000 steps of 0.1 s", [](Campaign& c) { c.tracer.time_step = 0.1; }, ""},
      {"DescentAlmostZero", "descent of 1 nm/s", [](Campaign& c) { c.descent_rate = 1e-9; }, ""},
      {"DescentInFreeFall", "descent of 1 m/s", [](Campaign& c) { c.descent_rate = 1; }, ""},
      {"GrainsLikeDust", "grains of 44 and 15 um (exchange rates a million times higher)",
       [](Campaign& c) {
         for_all(c, [](Species& s) {
           s.diameter *= 1e-3;
           s.coarse_graining *= 1e3;
         });
         c.scene.gas->viscosity *= 1e-6;  // else no blast goes through
       },
       ""},
      {"DensityOfTheGrainsHuge", "grains of 10^7 kg/m3",
       [](Campaign& c) {
         for_all(c, [](Species& s) { s.density = 1e7; });
         c.charging.layers = {{{"coke", 22.0 * 1e7 / 800}}, {{"ore", 60.0 * 1e7 / 3000}}};
       },
       ""},
      {"PressureHuge", "outlet at 1,000 bar", [](Campaign& c) { c.scene.gas->outlet_pressure = 1e8; }, ""},
      {"BlastOff", "blast switched off: 0 kg/s", [](Campaign& c) { blast(c, 0); }, "must be greater than 0"},
      {"BlastReversed", "blast reversed: inlets at a pressure below the outlet's",
       [](Campaign& c) {
         for (Inlet& inlet : c.scene.gas->inlets) {
           inlet.given = Inlet::Given::pressure;
           inlet.mass_flow = 0;
           inlet.pressure = 0.9 * c.scene.gas->outlet_pressure;
         }
       },
       "no gas flows in at 90000 Pa"},
      {"DescentTiny", "descent of 10^-30 m/s", [](Campaign& c) { c.descent_rate = 1e-30; }, ""},
      {"DescentDenormal", "descent of 10^-310 m/s, below the smallest normal number",
       [](Campaign& c) { c.descent_rate = 1e-310; }, "cannot be meant"},
      {"BlastTemperatureHuge", "blast of 10^300 K",
       [](Campaign& c) {
         for (Inlet& inlet : c.scene.gas->inlets) inlet.total_temperature = 1e300;
       },
       "cannot be meant"},
      {"FlatCells", "cells of 0.4 x 0.4 x 0.0008 m (500:1)",
       [](Campaign& c) {
         c.scene.mesh.cells = MeshCells{1, 1, {625, 15}};
         c.scene.mesh.cell = 0.13;
         c.tracer.duration = 3;
         c.scene.gas->inlets[0].size = c.scene.gas->inlets[1].size = {0.4, 0.13};
       },
       ""},
      {"CellsTooFlat", "cells of 0.4 x 0.4 x 0.0004 m (1000:1)",
       [](Campaign& c) {
         c.scene.mesh.cells = MeshCells{1, 1, {1250, 15}};
         c.scene.mesh.cell = 0.13;
         c.tracer.duration = 3;
         c.scene.gas->inlets[0].size = c.scene.gas->inlets[1].size = {0.4, 0.13};
       },
       "aspect ratio of 1000 is its limit"},
  };
}

class TracerExtremes : public ::testing::TestWithParam<Extreme> {};

TEST_P(TracerExtremes, EndsWellOrIsRefused) {
  const Extreme& extreme = GetParam();
  Campaign campaign = tiny();
  extreme.change(campaign);
  const testing::TracerRun run(CUPOLA_TRACER, campaign);
  if (!extreme.refusal.empty()) {
    EXPECT_TRUE(run.status() == 65 || run.status() == 70) << run.status();
    EXPECT_NE(run.sentence().find(extreme.refusal), std::string::npos) << run.sentence();
    std::cout << fmt::format("| tracer | {} | refused: \"... {} ...\" | | | {:.1f} |\n", extreme.what, extreme.refusal,
                             run.wall_seconds());
    return;
  }
  ASSERT_EQ(run.status(), 0) << run.sentence();
  const FieldFile result = run.result();
  const nlohmann::json summary = result.summary();
  const double mass = summary["ledger"]["mass"]["residual"];
  const double energy = summary["ledger"]["energy"]["residual"];
  EXPECT_LT(mass, 1e-10);
  EXPECT_LT(energy, 1e-3);  // of the blast's enthalpy: what issue and docs promise

  double lowest = std::min(campaign.charging.temperature, campaign.scene.heat_loss->ambient);
  lowest = std::min(lowest, campaign.initial.cohesive_zone->above);
  double highest = std::max(campaign.initial.cohesive_zone->below, campaign.initial.cohesive_zone->above);
  for (const Inlet& inlet : campaign.scene.gas->inlets) highest = std::max(highest, inlet.total_temperature);
  double least = HUGE_VAL;
  double most = 0;
  for (const char* field : {"solids_temperature", "gas_temperature"}) {
    for (const double value : result.cell_data(field)) {
      ASSERT_TRUE(std::isfinite(value)) << field;
      least = std::min(least, value);
      most = std::max(most, value);
    }
  }
  EXPECT_GT(least, lowest - 0.5);
  EXPECT_LT(most, highest + 0.5);
  std::cout << fmt::format("| tracer | {} | stable, {:.0f} to {:.0f} K | mass {:.1g}, energy {:.1g} | {} | {:.1f} |\n",
                           extreme.what, least, most, mass, energy, summary["steps"].get<long>(), run.wall_seconds());
}

INSTANTIATE_TEST_SUITE_P(Stage, TracerExtremes, ::testing::ValuesIn(extremes()),
                         [](const auto& info) { return info.param.name; });

}  // namespace
}  // namespace cupola
