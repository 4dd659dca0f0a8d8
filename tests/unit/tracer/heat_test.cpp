#include <gtest/gtest.h>

#include <cmath>

#include "stage_tracer/conduction.hpp"
#include "stage_tracer/exchange.hpp"
#include "stage_tracer/random.hpp"
#include "tests/support/box_mesh.hpp"
#include "tests/support/furnaces.hpp"

namespace cupola {
namespace {

Campaign hot_shaft() {
  Campaign campaign = furnaces::shaft();
  for (Species& species : campaign.species) {
    species.heat_capacity = 700;
    species.conductivity = 5;
  }
  campaign.heat = Heat{1.0};
  return campaign;
}

/// Gas of one void fraction everywhere.
struct GasHere {
  std::vector<Vector3> mass_flux;
  std::vector<double> temperature;
  std::vector<double> void_fraction = std::vector<double>(temperature.size(), 0.44);
  [[nodiscard]] Exchange::GasFields fields() const { return {mass_flux, temperature, void_fraction}; }
};

BySpecies capacity_of(const Campaign& campaign, const CellContents& contents) {
  BySpecies capacity = contents.volume;
  for (std::size_t s = 0; s < capacity.size(); ++s) {
    const auto here = volumetric_heat_capacity(campaign.species[s], contents.temperature[s]);
    for (std::size_t c = 0; c < here.size(); ++c) capacity[s][c] *= here[c];
  }
  return capacity;
}

BedMesh block() {
  testing::BoxMesh box;
  box.cells = {4, 3, 5};
  box.periodic_y = true;
  return box.make();
}

double noise(std::uint64_t id) { return random_uniform(7, RandomUse::seeding, id)[0]; }

/// Both species at random in the cells, some cells without one of them.
CellContents random_contents(const BedMesh& mesh) {
  CellContents contents;
  for (std::size_t s = 0; s < 2; ++s) {
    std::vector<double> volume(mesh.cells());
    std::vector<double> temperature(mesh.cells(), 0.0);
    for (std::size_t c = 0; c < mesh.cells(); ++c) {
      volume[c] = noise(1000 * s + c) < 0.3 ? 0 : 0.3 * mesh.cell_volume[c] * noise(10000 + 1000 * s + c);
      if (volume[c] > 0) temperature[c] = 300 + 1500 * noise(20000 + 1000 * s + c);
    }
    contents.volume.push_back(volume);
    contents.temperature.push_back(temperature);
  }
  return contents;
}

TEST(Exchange, SingleGrainFollowsThePublishedHeating) {
  // REFERENCE: a 3.6 mm grain at 373.15 K in air at 298.15 K and 6 m/s, Nu = 17.811.
  Campaign campaign = hot_shaft();
  Gas& gas = *campaign.scene.gas;
  gas.heat_capacity = 999.06;
  gas.viscosity = 1.8603e-5;
  gas.prandtl = gas.viscosity * gas.heat_capacity / 0.051865;
  campaign.species.resize(1);
  Species& grain = campaign.species[0];
  grain.diameter = 3.6e-3;
  grain.density = 8850;
  grain.heat_capacity = 55.0;
  const BedMesh mesh = block();
  const CellSpreading kernel(mesh, {}, 0.2);
  Exchange exchange(campaign, kernel);
  const GasHere here{std::vector<Vector3>(mesh.cells(), Vector3{0, 0, 1.1854 * 6}),
                     std::vector<double>(mesh.cells(), 298.15)};
  const CellContents contents{BySpecies(1, std::vector<double>(mesh.cells(), 1e-3)),
                              BySpecies(1, std::vector<double>(mesh.cells(), 373.15))};
  for (const auto& [time, expected] : {std::pair{0.1, 366.8415}, std::pair{0.5, 346.4858}, std::pair{1.0, 329.3014}}) {
    exchange.set_rates(here.fields(), contents);
    const double felt = exchange.felt_temperature(here.temperature)[0][17];
    const double temperature = felt + (373.15 - felt) * std::exp(-exchange.rate()[0][17] * time);
    EXPECT_NEAR(temperature, expected, 1e-4 * (expected - 298.15)) << "after " << time << " s";
  }
}

/// The campaign with properties that change with the temperature, latent heat and resistance inside the grains.
Campaign real_materials() {
  Campaign campaign = hot_shaft();
  campaign.species[0].heat_capacity = PropertyCurve({{300, 800}, {1500, 1700}});
  campaign.species[1].conductivity = PropertyCurve({{300, 20}, {1500, 2}});
  campaign.species[1].softening = Softening{1000, 1400, 200e3};
  campaign.heat->convection = Heat::Convection::gunn;
  campaign.heat->intragrain_resistance = true;
  campaign.scene.gas->viscosity_model = Gas::ViscosityModel::sutherland;
  campaign.scene.gas->sutherland = {1.716e-5, 273, 111};
  return campaign;
}

class ExchangeOfMaterials : public ::testing::TestWithParam<bool> {};

TEST_P(ExchangeOfMaterials, SolidsTakeExactlyWhatTheGasGivesForAnyStep) {
  const Campaign campaign = GetParam() ? real_materials() : hot_shaft();
  const BedMesh mesh = block();
  const CellSpreading kernel(mesh, {}, 0.3);
  Exchange exchange(campaign, kernel);
  const CellContents contents = random_contents(mesh);
  GasHere here{std::vector<Vector3>(mesh.cells()), std::vector<double>(mesh.cells())};
  auto& gas_temperature = here.temperature;
  for (std::size_t c = 0; c < mesh.cells(); ++c) {
    here.mass_flux[c] = {noise(31000 + c), 0, 2 * noise(32000 + c)};
    gas_temperature[c] = 300 + 2000 * noise(33000 + c);
  }
  for (const double step : {1e-5, 1e-2, 20.0, 1e4, 1e7}) {  // k dt from 1e-8 to above 1e3
    exchange.set_rates(here.fields(), contents);
    const SolidsExchange solids = exchange.solids(contents, step);
    double given = 0;
    double turnover = 0;
    for (std::size_t c = 0; c < mesh.cells(); ++c) {
      given += step * (solids.conductance[c] * gas_temperature[c] - solids.conductance_temperature[c]);
      turnover += step * solids.conductance_temperature[c];
    }
    const BySpecies felt = exchange.felt_temperature(gas_temperature);
    double taken = 0;
    for (std::size_t s = 0; s < 2; ++s) {
      const BySpecies capacity = capacity_of(campaign, contents);
      for (std::size_t c = 0; c < mesh.cells(); ++c) {
        taken -= capacity[s][c] * (felt[s][c] - contents.temperature[s][c]) * std::expm1(-exchange.rate()[s][c] * step);
      }
    }
    // With a tiny step the decay itself rounds: 1 - exp(-k dt) is known to round-off over k dt.
    EXPECT_NEAR(taken, given, 1e-11 * turnover + 1e-15 * turnover / std::min(1.0, step * 1e-3)) << "step " << step;
  }
}

INSTANTIATE_TEST_SUITE_P(Materials, ExchangeOfMaterials, ::testing::Bool());

TEST(Exchange, BiotNumbersAreReportedAndCorrected) {
  Campaign campaign = hot_shaft();
  const BedMesh mesh = block();
  const CellSpreading kernel(mesh, {}, 0.3);
  const CellContents contents = random_contents(mesh);
  const GasHere here{std::vector<Vector3>(mesh.cells(), Vector3{0, 0, 2}), std::vector<double>(mesh.cells(), 1500)};
  Exchange plain(campaign, kernel);
  plain.set_rates(here.fields(), contents);
  const double h = plain.coefficient()[0][3];
  EXPECT_NEAR(plain.largest_biot()[0], h * 0.044 / 6 / 5, 1e-12);
  campaign.heat->intragrain_resistance = true;
  Exchange corrected(campaign, kernel);
  corrected.set_rates(here.fields(), contents);
  EXPECT_NEAR(corrected.coefficient()[0][3], 1 / (1 / h + 0.044 / 50), 1e-9);
  EXPECT_DOUBLE_EQ(corrected.largest_biot()[0], plain.largest_biot()[0]);
}

TEST(Exchange, MeanDecayIsSmoothThroughZero) {
  EXPECT_DOUBLE_EQ(Exchange::mean_decay(0), 1);
  EXPECT_NEAR(Exchange::mean_decay(1e-10), 1 - 0.5e-10, 1e-15);
  EXPECT_NEAR(Exchange::mean_decay(1.0), 1 - std::exp(-1.0), 1e-15);
  EXPECT_NEAR(Exchange::mean_decay(1e3), 1e-3, 1e-15);
}

class ConductionTest : public ::testing::Test {
 protected:
  BedMesh mesh_ = block();
  Campaign campaign_ = hot_shaft();
  std::vector<bool> bed_ = std::vector<bool>(mesh_.cells(), true);
  std::vector<double> thickness_{0.4, 0.3};
  std::vector<double> share_{0.6, 0.4};

  double heat(const CellContents& contents, const BySpecies& temperature) const {
    double sum = 0;
    for (std::size_t s = 0; s < 2; ++s) {
      for (std::size_t c = 0; c < mesh_.cells(); ++c) {
        sum += campaign_.species[s].density * campaign_.species[s].heat_capacity.at(293) * contents.volume[s][c] *
               temperature[s][c];
      }
    }
    return sum;
  }
};

TEST_F(ConductionTest, KeepsTheHeatAndTheBounds) {
  const Conduction conduction(mesh_, campaign_, bed_, thickness_, share_);
  const CellContents contents = random_contents(mesh_);
  BySpecies packed(2, std::vector<double>(mesh_.cells()));
  for (std::size_t c = 0; c < mesh_.cells(); ++c) {
    const double total = contents.volume[0][c] + contents.volume[1][c];
    for (std::size_t s = 0; s < 2; ++s) {
      packed[s][c] = total > 0 ? 0.56 * mesh_.cell_volume[c] * contents.volume[s][c] / total : 0;
    }
  }
  for (const double step : {1.0, 1e3, 1e6}) {
    const Conduction::Result result = conduction.advance(contents, capacity_of(campaign_, contents), packed, step);
    EXPECT_NEAR(heat(contents, result.change), 0, 1e-12 * heat(contents, contents.temperature)) << "step " << step;
    EXPECT_GT(result.iterations, 0);
    for (std::size_t s = 0; s < 2; ++s) {
      for (std::size_t c = 0; c < mesh_.cells(); ++c) {
        if (contents.volume[s][c] <= 0) continue;
        const double after = contents.temperature[s][c] + result.change[s][c];
        EXPECT_GT(after, 300 - 0.1);
        EXPECT_LT(after, 1800 + 0.1);
      }
    }
  }
}

TEST_F(ConductionTest, EveryLawKeepsTheHeat) {
  const CellContents contents = random_contents(mesh_);
  campaign_.species[0].heat_capacity = PropertyCurve({{300, 800}, {1500, 1700}});
  campaign_.species[0].conductivity = PropertyCurve({{300, 1}, {1500, 4}});
  for (const auto law :
       {Heat::BedConduction::carson, Heat::BedConduction::zehner_bauer_schluender, Heat::BedConduction::mixture}) {
    campaign_.heat->bed_conduction = law;
    const Conduction conduction(mesh_, campaign_, bed_, thickness_, share_);
    BySpecies packed = contents.volume;
    for (auto& volume : packed) {
      for (double& v : volume) v *= 2;
    }
    const BySpecies capacity = capacity_of(campaign_, contents);
    const auto result = conduction.advance(contents, capacity, packed, 1e4);
    double gained = 0, turnover = 0;
    for (std::size_t s = 0; s < 2; ++s) {
      for (std::size_t c = 0; c < mesh_.cells(); ++c) {
        gained += capacity[s][c] * result.change[s][c];
        turnover += capacity[s][c] * std::abs(result.change[s][c]);
      }
    }
    EXPECT_GT(turnover, 0);
    EXPECT_LT(std::abs(gained), 1e-11 * turnover);
    EXPECT_EQ(result.walls, 0);
  }
}

TEST_F(ConductionTest, MixtureCouplesSpeciesOfNeighbours) {
  campaign_.heat->bed_conduction = Heat::BedConduction::mixture;
  const Conduction conduction(mesh_, campaign_, bed_, thickness_, share_);
  CellContents contents;
  for (std::size_t s = 0; s < 2; ++s) {
    contents.volume.emplace_back(mesh_.cells(), 0.28 * mesh_.cell_volume[0]);
    contents.temperature.emplace_back(mesh_.cells(), s == 0 ? 1000.0 : 400.0);
  }
  const auto change = conduction.advance(contents, capacity_of(campaign_, contents), contents.volume, 1e9).change;
  // In the end both species have the mixture's temperature.
  const double mixed = (800 * 1000 + 3000 * 400) / 3800.0;
  EXPECT_NEAR(contents.temperature[0][7] + change[0][7], mixed, 0.02);
  EXPECT_NEAR(contents.temperature[1][7] + change[1][7], mixed, 0.02);
}

TEST_F(ConductionTest, SolidsAtWallsLoseWhatTheLedgerIsTold) {
  campaign_.scene.heat_loss = WallHeatLoss{20, 300, WallHeatLoss::On::solids};
  const Conduction conduction(mesh_, campaign_, bed_, thickness_, share_);
  CellContents contents = random_contents(mesh_);
  const BySpecies capacity = capacity_of(campaign_, contents);
  const auto result = conduction.advance(contents, capacity, contents.volume, 100);
  double gained = 0;
  for (std::size_t s = 0; s < 2; ++s) {
    for (std::size_t c = 0; c < mesh_.cells(); ++c) gained += capacity[s][c] * result.change[s][c];
  }
  EXPECT_GT(result.walls, 0);
  EXPECT_NEAR(gained, -result.walls, 1e-11 * result.walls);
}

TEST_F(ConductionTest, SlabBetweenTwoPlatesHasALinearSteadyProfile) {
  const Conduction conduction(mesh_, campaign_, bed_, thickness_, share_);
  CellContents contents;
  contents.volume = {std::vector<double>(mesh_.cells()), std::vector<double>(mesh_.cells(), 0.0)};
  contents.temperature = {std::vector<double>(mesh_.cells(), 0.0), std::vector<double>(mesh_.cells(), 0.0)};
  std::vector<bool> free(mesh_.cells(), true);
  for (std::size_t c = 0; c < mesh_.cells(); ++c) {
    contents.volume[0][c] = 0.6 * mesh_.cell_volume[c];
    const double z = mesh_.cell_centre[c][2];
    if (z < 0.15) contents.temperature[0][c] = 1000;
    if (z > 0.85) contents.temperature[0][c] = 400;
    free[c] = z > 0.15 && z < 0.85;
  }
  const BySpecies nothing(2, std::vector<double>(mesh_.cells(), 0.0));
  const BySpecies steady = conduction.steady(contents, contents.volume, free, nothing, nothing);
  for (std::size_t c = 0; c < mesh_.cells(); ++c) {
    EXPECT_NEAR(steady[0][c], 1000 - 600 * (mesh_.cell_centre[c][2] - 0.1) / 0.8, 1e-3);
  }
}

TEST_F(ConductionTest, SpeciesInLayersMeetThroughTheExchangeOfTheRecipe) {
  // Cells in the recipe's proportions, uniform: only the exchange between the species acts, and its implicit step is
  // known.
  const Conduction conduction(mesh_, campaign_, bed_, thickness_, share_);
  CellContents contents;
  const double solids = 0.56;
  for (std::size_t s = 0; s < 2; ++s) {
    contents.volume.emplace_back(mesh_.cells(), share_[s] * solids * mesh_.cell_volume[0]);
    contents.temperature.emplace_back(mesh_.cells(), s == 0 ? 1000.0 : 400.0);
  }
  const double step = 50;
  const auto change = conduction.advance(contents, capacity_of(campaign_, contents), contents.volume, step).change;
  const double k = 5 * (3 * solids - 1) / 2;
  const double exchange = 12 / (0.7 * (0.4 / k + 0.3 / k));
  const double coke = share_[0] * solids * 800 * 700;
  const double ore = share_[1] * solids * 3000 * 700;
  const double difference = 600 / (1 + step * exchange * (1 / coke + 1 / ore));
  EXPECT_NEAR(change[0][7], -step * exchange * difference / coke, 1e-5);
  EXPECT_NEAR(change[1][7], step * exchange * difference / ore, 1e-5);
}

TEST_F(ConductionTest, NoTracerLeavesTheTemperaturesThatConductToItHoweverLittleItHolds) {
  const Conduction conduction(mesh_, campaign_, bed_, thickness_, share_);
  const CellContents contents = random_contents(mesh_);
  const BySpecies whole = capacity_of(campaign_, contents);
  double lowest = 1e9, highest = 0;
  for (const auto& of_species : contents.temperature) {
    for (const double mean : of_species) {
      if (mean <= 0) continue;
      lowest = std::min(lowest, mean);
      highest = std::max(highest, mean);
    }
  }
  for (const double part : {1.0, 1e-8}) {
    BySpecies capacity = whole;
    for (auto& of_species : capacity) {
      for (double& value : of_species) value *= part;
    }
    const auto result = conduction.advance(contents, capacity, contents.volume, 100);
    for (std::size_t s = 0; s < 2; ++s) {
      for (std::size_t c = 0; c < mesh_.cells(); ++c) {
        if (!(capacity[s][c] > 0)) continue;
        const double damping = result.damping[s][c];
        if (part == 1.0) {
          EXPECT_EQ(damping, 0);  // so little conducted in a step: grains keep their distance from the mean
          continue;
        }
        // The coldest and the hottest tracer there can be, in a cell of any mean.
        for (const double own : {lowest, highest}) {
          const double after = own + result.change[s][c] + damping * (contents.temperature[s][c] - own);
          EXPECT_GT(after, lowest - 1);
          EXPECT_LT(after, highest + 1);
        }
      }
    }
  }
}

}  // namespace
}  // namespace cupola
