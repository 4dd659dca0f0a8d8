#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>

#include "schemas/campaign_reader.hpp"
#include "schemas/gas_presets.hpp"
#include "tests/support/tracer_program.hpp"

namespace cupola {
namespace {

Campaign tiny(double duration) {
  Campaign campaign = load_campaign(std::filesystem::path(CUPOLA_SOURCE_DIR) / "cases" / "tiny" / "campaign.yaml");
  campaign.tracer.duration = duration;
  return campaign;
}

/// Every law and property that changes with the temperature, in one campaign.
Campaign real_materials(double duration) {
  Campaign campaign = tiny(duration);
  for (Species& species : campaign.species) {
    species.heat_capacity = PropertyCurve({{300, 700}, {900, 1000}, {1800, 1200}});
    species.conductivity = PropertyCurve({{300, 3}, {1800, 1}});
    if (species.softening) species.softening->latent_heat = 250e3;
  }
  Gas& gas = *campaign.scene.gas;
  for (const auto& preset : gas_presets()) {
    if (preset.name != "nitrogen") continue;
    gas.sutherland = preset.sutherland;
    gas.janaf = preset.janaf;
  }
  gas.viscosity_model = Gas::ViscosityModel::sutherland;
  gas.heat_capacity_model = Gas::HeatCapacityModel::janaf;
  campaign.heat->convection = Heat::Convection::gunn;
  campaign.heat->bed_conduction = Heat::BedConduction::zehner_bauer_schluender;
  campaign.heat->intragrain_resistance = true;
  campaign.scene.heat_loss = WallHeatLoss{20, 293, WallHeatLoss::On::both};
  return campaign;
}

double residual(const testing::TracerProgram& program) {
  const nlohmann::json summary = program.result().summary();
  const nlohmann::json& energy = summary["ledger"]["energy"];
  std::printf("energy: blast %.6g J, walls %.4g, melt %.4g, residual %.2g; Biot numbers %s\n",
              energy["blast"].get<double>(), energy["walls"].get<double>(), energy["melt"].get<double>(),
              energy["residual"].get<double>(), summary["biot_largest"].dump().c_str());
  EXPECT_GT(energy["walls"].get<double>(), 0);
  return energy["residual"].get<double>();
}

TEST(Materials, LedgerClosesWithPropertiesOverTheTemperatureAndLatentHeat) {
  const testing::TracerProgram program(real_materials(600));
  ASSERT_EQ(program.run(), 0) << program.failure();
  EXPECT_LT(residual(program), 1e-9);
}

TEST(Materials, EveryWallLossAndConductionClosesTheLedger) {
  for (const auto on : {WallHeatLoss::On::gas, WallHeatLoss::On::solids, WallHeatLoss::On::both}) {
    for (const auto law : {Heat::BedConduction::carson, Heat::BedConduction::mixture}) {
      Campaign campaign = tiny(100);
      campaign.scene.heat_loss = WallHeatLoss{20, 293, on};
      campaign.heat->bed_conduction = law;
      campaign.heat->convection = Heat::Convection::wakao;
      const testing::TracerProgram with(campaign);
      ASSERT_EQ(with.run(), 0) << with.failure();
      EXPECT_LT(residual(with), 1e-9);
    }
  }
}

TEST(Materials, NavierStokesMarchesAndIsComparedWithDarcyForchheimer) {
  Campaign campaign = tiny(60);
  campaign.tracer.gas = TracerSettings::GasModel::navier_stokes;
  campaign.tracer.compare_gas_models = true;
  const testing::TracerProgram program(campaign);
  ASSERT_EQ(program.run(), 0) << program.failure();
  EXPECT_LT(residual(program), 1e-9);
  const nlohmann::json models = program.result().summary()["gas_models"];
  ASSERT_TRUE(models.contains("rows")) << models.dump();
  std::printf("%s\n", models.dump(1).c_str());
  const nlohmann::json& rows = models["rows"];
  EXPECT_GT(rows.front()["mass_flux"].get<double>(), rows.back()["mass_flux"].get<double>());
  const auto inertia = program.result().cell_data("gas_inertia_over_drag");
  EXPECT_EQ(inertia.size(), program.mesh().cells());
}

}  // namespace
}  // namespace cupola
