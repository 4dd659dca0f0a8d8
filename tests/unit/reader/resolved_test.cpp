#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <limits>

#include "schemas/campaign_reader.hpp"
#include "schemas/files.hpp"
#include "schemas/resolved_campaign.hpp"
#include "schemas/yaml_document.hpp"
#include "schemas/yaml_text.hpp"
#include "tests/unit/reader/base_campaign.hpp"

namespace cupola {
namespace {

Campaign read(const std::string& text) {
  auto result = read_campaign_text(text, "file");
  EXPECT_TRUE(result.ok()) << to_text(result.errors);
  return result.campaign;
}

std::vector<std::filesystem::path> case_files() {
  std::vector<std::filesystem::path> files;
  for (const auto& entry : std::filesystem::directory_iterator(std::filesystem::path(CUPOLA_SOURCE) / "cases")) {
    if (std::filesystem::exists(entry.path() / "campaign.yaml")) files.push_back(entry.path() / "campaign.yaml");
  }
  return files;
}

TEST(ResolvedCampaign, ReadsBackTheSameForEveryCase) {
  ASSERT_GE(case_files().size(), 3U);
  for (const auto& file : case_files()) {
    const auto campaign = load_campaign(file);
    EXPECT_EQ(resolved_json(read(resolved_yaml(campaign))), resolved_json(campaign)) << file;
  }
}

TEST(ResolvedCampaign, KeepsEveryBit) {
  auto campaign = read(test::base_campaign);
  campaign.descent_rate = 1.0 / 3.0 * 1e-3;
  campaign.contacts.youngs_modulus = std::nextafter(5e7, 1e8);
  campaign.tracer.duration = 1e22 / 3;
  campaign.dem.window = std::nextafter(1e-60, 1.0);  // the smallest that a file may hold
  campaign.dem.block = campaign.dem.window;
  campaign.scene.geometry.profile[0][0] = -0.0;
  campaign.random_seed = 9007199254740991U;
  campaign.dem.time_step = campaign.dem.block;
  const auto again = read(resolved_yaml(campaign));
  EXPECT_EQ(again.descent_rate, campaign.descent_rate);
  EXPECT_EQ(again.contacts.youngs_modulus, campaign.contacts.youngs_modulus);
  EXPECT_EQ(again.tracer.duration, campaign.tracer.duration);
  EXPECT_EQ(again.dem.window, campaign.dem.window);
  EXPECT_TRUE(std::signbit(again.scene.geometry.profile[0][0]));
  EXPECT_EQ(again.random_seed, campaign.random_seed);
  EXPECT_EQ(again.dem.time_step, campaign.dem.time_step);
}

TEST(ResolvedCampaign, KeepsRingsAndTheStopOfTheTracerStage) {
  const auto campaign = read(test::spoilt(
      "{ore: 600 kg}]}",
      "{ore: 600 kg, ring: [20 cm, 1 m]}]}\n"
      "tracer: {accuracy: 2 %, duration: 2 h, stop: {when: steady}, displacement: random-and-relaxation, "
      "displacement_excludes: {above_cohesive_zone: false, boxes: [{x: [-1, 1], y: [0, 0.1], z: [2, 3]}]}}"));
  EXPECT_FALSE(campaign.charging.ring_of(0));
  ASSERT_TRUE(campaign.charging.ring_of(1));
  EXPECT_DOUBLE_EQ((*campaign.charging.ring_of(1))[0], 0.2);
  EXPECT_DOUBLE_EQ(campaign.tracer.longest(), 7200);  // the duration, where at_most is not given
  EXPECT_DOUBLE_EQ(campaign.tracer.remaining_change, 0.02);
  EXPECT_DOUBLE_EQ(campaign.tracer.displacement_excludes.boxes[0][1][2], 3);
  EXPECT_EQ(resolved_json(read(resolved_yaml(campaign))), resolved_json(campaign));
}

TEST(ResolvedCampaign, KeepsTheStrategy) {
  const auto campaign = read(test::base_campaign + "strategy: predict-and-verify\npredict_and_verify: {windows: 7}\n");
  EXPECT_EQ(campaign.strategy, Strategy::predict_and_verify);
  EXPECT_EQ(read(resolved_yaml(campaign)).predict_and_verify.windows, 7);
  EXPECT_FALSE(resolved_json(read(test::base_campaign)).contains("predict_and_verify"));
}

TEST(ResolvedCampaign, KeepsTheModelsOfTheDemStage) {
  auto campaign = read(test::base_campaign);
  EXPECT_FALSE(campaign.filtered_drag);
  EXPECT_EQ(campaign.dem.void_fraction, DemSettings::VoidFraction::divided);
  EXPECT_DOUBLE_EQ(campaign.dem.smoothing_length, 0.176);  // the largest parcel
  EXPECT_EQ(campaign.raceways[0].removal, Raceway::Removal::rate);
  EXPECT_GT(campaign.dem.limits.overlap, 0.15);  // the paper's own contacts are within the limits
  EXPECT_GT(campaign.dem.limits.wall_overlap, 0.42);

  campaign.drag = DragLaw::emms;
  campaign.filtered_drag = FilteredDrag{0.03, false};
  campaign.contacts.model = Contacts::Model::linear_spring;
  campaign.contacts.stiffness = 1e4;
  campaign.contacts.tangential_ratio = 0.5;
  campaign.dem.void_fraction = DemSettings::VoidFraction::smoothed;
  campaign.dem.smoothing_length = 0.3;
  campaign.dem.limits = {0.2, 0.5, 0.1};
  campaign.dem.gas = DemSettings::GasModel::transient;
  campaign.dem.transient = {1e-3, 0.25, 3, TransientGas::Turbulence::realizable_k_epsilon};
  campaign.dead_man = {2.5, 0.8};
  campaign.contacts.stiffness_of = Contacts::StiffnessOf::parcel;
  campaign.contacts.rolling_model = Contacts::Rolling::epsd;
  campaign.contacts.rolling_damping = 0.2;
  campaign.raceways[0].removal = Raceway::Removal::keep_void;
  const auto again = read(resolved_yaml(campaign));
  EXPECT_EQ(resolved_json(again), resolved_json(campaign));
  EXPECT_EQ(again.drag, DragLaw::emms);
  EXPECT_EQ(again.filtered_drag->parcel_coefficient, 0.03);
  EXPECT_FALSE(again.filtered_drag->grid);
  EXPECT_EQ(again.contacts.tangential_ratio, 0.5);
  EXPECT_EQ(again.dem.void_fraction, DemSettings::VoidFraction::smoothed);
  EXPECT_EQ(again.dem.smoothing_length, 0.3);
  EXPECT_EQ(again.dem.limits.wall_overlap, 0.5);
  EXPECT_EQ(again.dem.limits.creep, 0.1);
  EXPECT_EQ(again.dem.gas, DemSettings::GasModel::transient);
  EXPECT_EQ(again.dem.transient.time_step, 1e-3);
  EXPECT_EQ(again.dem.transient.courant, 0.25);
  EXPECT_EQ(again.dem.transient.corrections, 3);
  EXPECT_EQ(again.dem.transient.turbulence, TransientGas::Turbulence::realizable_k_epsilon);
  EXPECT_EQ(again.dead_man->tip, 2.5);
  EXPECT_EQ(again.dead_man->slope, 0.8);
  EXPECT_EQ(again.contacts.stiffness_of, Contacts::StiffnessOf::parcel);
  EXPECT_EQ(again.contacts.rolling_model, Contacts::Rolling::epsd);
  EXPECT_EQ(again.contacts.rolling_damping, 0.2);
  EXPECT_EQ(again.raceways[0].removal, Raceway::Removal::keep_void);
}

TEST(ResolvedCampaign, KeepsTheOrderOfSpecies) {
  auto campaign = read(test::base_campaign);
  std::swap(campaign.species[0], campaign.species[1]);
  campaign.contacts.pairs["ore-coke"] = campaign.contacts.pairs.extract("coke-ore").mapped();
  const auto again = read(resolved_yaml(campaign));
  EXPECT_EQ(again.species[0].name, "ore");
  EXPECT_EQ(resolved_json(again), resolved_json(campaign));
}

TEST(CampaignDefaults, AreDerivedFromTheScene) {
  const auto campaign = read(test::base_campaign);
  EXPECT_DOUBLE_EQ(campaign.species[1].none_below, 1.7);  // top of the raceway + 1 m
  EXPECT_DOUBLE_EQ(campaign.charging.hopper_height, 200 / 800. / 0.55 / (2 * 1.2 * 0.6) + 0.5);
  EXPECT_DOUBLE_EQ(campaign.hopper_top(), 6 + campaign.charging.hopper_height);
  EXPECT_EQ(campaign.dem.gas, DemSettings::GasModel::quasi_steady);
  EXPECT_TRUE(campaign.contacts.pairs.contains("coke-ore"));  // given as ore-coke
  EXPECT_NEAR(campaign.scene.gas->heat_capacity, 1041.945, 1e-3);
  EXPECT_DOUBLE_EQ(campaign.half_width(3.5), 1.35);
}

/// Every key of gas and heat that is no default comes back.
TEST(ResolvedCampaign, KeepsPropertiesOverTheTemperature) {
  auto text =
      test::spoilt("heat_capacity: 850, conductivity: 1.7",
                   "heat_capacity: [[300 K, 0.8 kJ/kg/K], [1300 K, 1.6 kJ/kg/K]], conductivity: [[300, 2], [500, 1]]");
  const auto replace = [&](const std::string& from, const std::string& to) {
    text.replace(text.find(from), from.size(), to);
  };
  replace("melted: 1675 K", "melted: 1675 K, latent_heat: 250 kJ/kg");
  replace("mass_flow: 1.4 kg/s", "pressure: 1.2 bar");
  replace("species: blast\n", "species: blast\n    viscosity_model: sutherland\n    heat_capacity_model: janaf\n");
  replace("heat: {}",
          "heat: {convection: wakao, bed_conduction: zehner-bauer-schluender, emissivity: 0.7, "
          "intragrain_resistance: true}\ntracer: {gas: navier-stokes, compare_gas_models: true}");
  replace("species:\n  coke", "  walls: {heat_loss: {coefficient: 20, on: both}}\nspecies:\n  coke");
  const auto campaign = read(text);
  const auto& coke = campaign.species[0];
  EXPECT_DOUBLE_EQ(coke.heat_capacity.at(800), 1200);
  EXPECT_DOUBLE_EQ(coke.heat_capacity.at(2000), 1600);
  EXPECT_DOUBLE_EQ(coke.conductivity.at(400), 1.5);
  EXPECT_DOUBLE_EQ(campaign.species[1].softening->latent_heat, 250e3);
  const auto& gas = *campaign.scene.gas;
  EXPECT_EQ(gas.inlets[0].given, Inlet::Given::pressure);
  EXPECT_DOUBLE_EQ(gas.inlets[0].pressure, 1.2e5);
  EXPECT_EQ(gas.viscosity_model, Gas::ViscosityModel::sutherland);
  EXPECT_DOUBLE_EQ(gas.sutherland.constant, 107);
  EXPECT_EQ(gas.heat_capacity_model, Gas::HeatCapacityModel::janaf);
  EXPECT_DOUBLE_EQ(gas.janaf.low[0], 3.53100528);
  EXPECT_EQ(campaign.scene.heat_loss->on, WallHeatLoss::On::both);
  EXPECT_EQ(campaign.heat->convection, Heat::Convection::wakao);
  EXPECT_EQ(campaign.heat->bed_conduction, Heat::BedConduction::zehner_bauer_schluender);
  EXPECT_DOUBLE_EQ(campaign.heat->emissivity, 0.7);
  EXPECT_TRUE(campaign.heat->intragrain_resistance);
  EXPECT_EQ(campaign.tracer.gas, TracerSettings::GasModel::navier_stokes);
  EXPECT_TRUE(campaign.tracer.compare_gas_models);
  EXPECT_EQ(resolved_json(read(resolved_yaml(campaign))), resolved_json(campaign));
}

TEST(PropertyCurve, IntegratesItsStraightLinesExactly) {
  const PropertyCurve curve({{300, 800}, {1300, 1600}, {1500, 1600}});
  EXPECT_DOUBLE_EQ(curve.at(300), 800);
  EXPECT_DOUBLE_EQ(curve.at(100), 800);
  EXPECT_DOUBLE_EQ(curve.integral(300, 1300), 1.2e6);
  EXPECT_DOUBLE_EQ(curve.integral(100, 300), 160e3);
  EXPECT_DOUBLE_EQ(curve.integral(1300, 300), -1.2e6);
  EXPECT_DOUBLE_EQ(curve.integral(1400, 2000), 960e3);
  EXPECT_DOUBLE_EQ(curve.mean(300, 1300), 1200);
  EXPECT_DOUBLE_EQ(curve.mean(800, 800), 1200);
  EXPECT_DOUBLE_EQ(PropertyCurve(850).integral(293, 1293), 850e3);
}

TEST(CampaignDefaults, OwnGasPropertiesTakeThePlaceOfThePresets) {
  const auto campaign = read(test::spoilt("species: blast", "species: blast\n    viscosity: 5e-5 Pa s"));
  EXPECT_DOUBLE_EQ(campaign.scene.gas->viscosity, 5e-5);
  EXPECT_DOUBLE_EQ(campaign.scene.gas->prandtl, 0.8);
}

TEST(CampaignDefaults, CountedCellsGiveTheMeanCellHeight) {
  const auto campaign = read(test::spoilt("{cell: 0.2 m}", "{cells: {half_width: 8, depth: 3, heights: [4, 8]}}"));
  ASSERT_TRUE(campaign.scene.mesh.cells.has_value());
  EXPECT_DOUBLE_EQ(campaign.scene.mesh.cell, 0.5);
}

/// Every `default` of the schema is what the reader fills in.
void compare_defaults(const nlohmann::json& schema, const nlohmann::ordered_json& resolved, const std::string& path,
                      int& compared) {
  if (schema.contains("default")) {
    ++compared;
    EXPECT_EQ(nlohmann::json(resolved), schema["default"]) << path;
  }
  if (!schema.contains("properties")) return;
  for (const auto& [key, member] : schema["properties"].items()) {
    if (resolved.contains(key)) compare_defaults(member, resolved[key], path_of(path, key), compared);
  }
}

TEST(CampaignDefaults, AreThoseOfThePublishedSchema) {
  const auto text = test::spoilt(
      "raceways:\n  - {box: {x: [1, 1.5], y: [-0.3, 0.3], z: [0.3, 0.7]}, dem_removal_rate: 50 kg/s}\n", "");
  int compared = 0;
  compare_defaults(nlohmann::json::parse(campaign_schema()), resolved_json(read(text)), "", compared);
  EXPECT_GE(compared, 35);
}

TEST(CampaignManual, ExplainsEveryKey) {
  const auto manual = read_text(std::filesystem::path(CUPOLA_SOURCE) / "docs/campaign_file.md");
  const auto explained = [&](const std::string& word) { return manual.find("`" + word + "`") != std::string::npos; };
  std::vector<nlohmann::json> open{nlohmann::json::parse(campaign_schema())};
  while (!open.empty()) {
    const auto schema = open.back();
    open.pop_back();
    for (const auto* inner : {"items", "additionalProperties"}) {
      if (schema.contains(inner) && schema[inner].is_object()) open.push_back(schema[inner]);
    }
    for (const auto* inner : {"properties", "patternProperties"}) {
      if (!schema.contains(inner)) continue;
      for (const auto& [key, member] : schema[inner].items()) {
        open.push_back(member);
        if (inner == std::string("properties")) {
          EXPECT_TRUE(explained(key)) << key;
        }
        if (member.contains("enum")) {
          for (const auto& word : member["enum"]) EXPECT_TRUE(explained(word)) << word;
        }
      }
    }
  }
}

}  // namespace
}  // namespace cupola
