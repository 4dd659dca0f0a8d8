#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>
#include <map>
#include <random>

#include "physics/closures/convection.hpp"
#include "physics/closures/gas_properties.hpp"
#include "physics/mesh/bed_mesh.hpp"
#include "physics/plan/charge.hpp"
#include "schemas/campaign_reader.hpp"
#include "schemas/field_file.hpp"
#include "schemas/files.hpp"
#include "schemas/task.hpp"
#include "stage_tracer/march_windows.hpp"
#include "tests/support/stated_bed.hpp"
#include "tests/support/temporary_folder.hpp"

namespace cupola {
namespace {

/// One species that descends through a box without heat loss, its conduction negligible, blown from below; used up in
/// the lowest cells.
const char* const moving_bed = R"yaml(
campaign: moving-bed
scene:
  geometry: {box: {width: 0.4 m, depth: 0.4 m, height: 2 m}}
  mesh: {cell: 0.025 m, cells: {half_width: 1, depth: 2, heights: [80]}}
  gas:
    species: air
    inlets: [{name: blast, side: bottom, mass_flow: 0.2 kg/s, total_temperature: 1200 K}]
species:
  pebble: {diameter: 30 mm, coarse_graining: 2, density: 1500 kg/m3, heat_capacity: 500 J/kg/K, conductivity: 1e-6 W/m/K}
contacts:
  pairs:
    pebble-pebble: {restitution: 0.5, friction: 0.5, rolling: 0.1}
    pebble-wall: {restitution: 0.5, friction: 0.3, rolling: 0.02}
heat: {nusselt_factor: 1}
charging: {stock_line: 2 m, temperature: 300 K, layers: [{pebble: 20 kg}]}
raceways: [{box: {x: [-0.2 m, 0.2 m], y: [-0.2 m, 0.2 m], z: [0 m, 0.2 m]}, void: 0.3, dem_removal_rate: 10 kg/s}]
descent_rate: 2 mm/s
dem: {stop: {at_most: 5 s}}
)yaml";

/// A small shaft with ore that softens, on coarse cells.
const char* const shaft = R"yaml(
campaign: shaft
scene:
  geometry:
    slot: {depth: 0.45 m, sides: periodic, profile: [[-0.5, 2.0], [0.3, 2.0], [1.2, 2.4], [6.5, 1.6], [7.0, 1.6]]}
  mesh: {cell: 0.3 m}
  gas:
    species: blast
    inlets:
      - {name: left, side: left, z: 0.0 m, size: [0.25 m, 0.25 m], mass_flow: 0.85 kg/s, total_temperature: 2600 K}
      - {name: right, side: right, z: 0.0 m, size: [0.25 m, 0.25 m], mass_flow: 0.85 kg/s, total_temperature: 2600 K}
    outlet: {pressure: 1 bar}
  walls: {heat_loss: {coefficient: 20 W/m2/K, ambient: 293 K}}
species:
  coke: {diameter: 44 mm, coarse_graining: 4, density: 800 kg/m3, heat_capacity: 850 J/kg/K, conductivity: 1.7 W/m/K}
  ore: {diameter: 15 mm, coarse_graining: 10, density: 3000 kg/m3, heat_capacity: 600 J/kg/K, conductivity: 80 W/m/K,
        softening: {from: 1475 K, melted: 1675 K}, none_below: 1.4 m}
contacts:
  pairs:
    coke-coke: {restitution: 0.5, friction: 0.9, rolling: 0.5}
    ore-ore: {restitution: 0.5, friction: 0.8, rolling: 0.4}
    coke-ore: {restitution: 0.2, friction: 0.8, rolling: 0.02}
    coke-wall: {restitution: 0.5, friction: 0.5, rolling: 0.02}
    ore-wall: {restitution: 0.2, friction: 0.2, rolling: 0.02}
drag: beetstra
heat: {nusselt_factor: 0.1}
charging: {stock_line: 6.1 m, layers: [{coke: 270 kg}, {ore: 780 kg}]}
raceways:
  - {box: {x: [-2.0 m, -1.0 m], y: [-0.225 m, 0.225 m], z: [-0.3 m, 0.4 m]}, void: 0.75, dem_removal_rate: 50 kg/s}
  - {box: {x: [1.0 m, 2.0 m], y: [-0.225 m, 0.225 m], z: [-0.3 m, 0.4 m]}, void: 0.75, dem_removal_rate: 50 kg/s}
descent_rate: 1.2 mm/s
dem: {stop: {at_most: 5 s}}
)yaml";

std::string replaced(std::string text, const std::string& what, const std::string& with, bool all = true) {
  for (std::size_t at = text.find(what); at != std::string::npos; at = text.find(what, at + with.size())) {
    text.replace(at, what.size(), with);
    if (!all) break;
  }
  return text;
}

using Inputs = std::map<std::string, std::filesystem::path>;

/// Runs a task of the tracer program in a folder. @return its exit status
int run(const std::filesystem::path& folder, const std::string& text, TaskKind kind, const Inputs& inputs) {
  const ReadCampaign read = read_campaign_text(text, "campaign.yaml");
  if (!read.ok()) throw std::runtime_error(to_text(read.errors));
  Task task;
  task.kind = kind;
  task.campaign = read.campaign;
  task.campaign_hash = hash_text("one furnace");  // the mesh carries it
  task.program_version = "test";
  for (const auto& [name, file] : inputs) task.inputs[name] = {file, hash_file(file)};
  std::filesystem::create_directories(folder);
  write_task(folder, task);
  const std::string program = CUPOLA_TRACER;
  const int prepared = std::system((program + " prepare " + folder.string() + " > /dev/null").c_str());
  if (prepared != 0) return prepared;
  return std::system((program + " " + folder.string() + " > /dev/null 2>&1").c_str());
}

/// Predicts a campaign in a folder. @param guess result of another prediction on the same mesh; empty: none
/// @param motion a DEM result on that mesh; empty: none
/// @return exit status of the program
int predict(const std::filesystem::path& folder, const std::string& text, const std::filesystem::path& guess = {},
            const std::filesystem::path& motion = {}) {
  Inputs inputs;
  if (!guess.empty()) inputs["solids_temperature"] = guess;
  if (!motion.empty()) inputs["granular"] = motion;
  return run(folder, text, TaskKind::predict, inputs);
}

nlohmann::json summary(const std::filesystem::path& folder) {
  return FieldFile(folder / "result.hdf", "tracer-result").summary();
}

TEST(Predictor, CounterCurrentProfileIsTheExactExponential) {
  const TemporaryFolder folder;
  ASSERT_EQ(predict(folder.path(), moving_bed), 0);
  const Campaign campaign = read_campaign_text(moving_bed, "").campaign;
  const BedMesh mesh = BedMesh::read(folder.path() / "foam" / "mesh.hdf");
  const FieldFile result(folder.path() / "result.hdf", "tracer-result");
  EXPECT_TRUE(result.summary()["prediction"]["converged"].get<bool>());
  const auto gas = result.cell_data("gas_temperature");
  const auto solids = result.cell_data("solids_temperature");
  // A least-squares slope of the logarithm of the difference, away from removal and stock plane.
  double n = 0, sz = 0, sl = 0, szz = 0, szl = 0;
  for (std::size_t c = 0; c < mesh.cells(); ++c) {
    const double z = mesh.cell_centre[c][2];
    if (z < 0.4 || z > 1.8) continue;
    ASSERT_GT(gas[c], solids[c]);
    const double l = std::log(gas[c] - solids[c]);
    n += 1;
    sz += z;
    sl += l;
    szz += z * z;
    szl += z * l;
  }
  const double slope = (n * szl - sz * sl) / (n * szz - sz * sz);
  const Species& pebble = campaign.species[0];
  const Gas& air = *campaign.scene.gas;
  const double mass_flux = 0.2 / 0.16;
  const GasAround around{mass_flux, air.viscosity, air.prandtl,
                         gas_conductivity(air.viscosity, air.heat_capacity, air.prandtl), 1 - expected_packing};
  const double h = heat_transfer_coefficient(*campaign.heat, around, pebble.diameter);
  const double exchange = h * 6 * expected_packing / pebble.diameter;
  const double solids_flow = campaign.descent_rate * expected_packing * pebble.density * 500;
  const double exact = exchange * (1 / solids_flow - 1 / (mass_flux * air.heat_capacity));
  EXPECT_NEAR(slope, exact, 2e-3 * std::abs(exact));
  EXPECT_LT(result.summary()["ledger"]["energy"]["residual"].get<double>(), 1e-3);
}

TEST(Predictor, TheFirstGuessDoesNotMatter) {
  const TemporaryFolder folder;
  const std::string hotter = replaced(shaft, "0.85 kg/s", "1.0 kg/s");
  ASSERT_EQ(predict(folder.path() / "plan", shaft), 0);
  ASSERT_EQ(predict(folder.path() / "hotter", hotter), 0);
  ASSERT_EQ(predict(folder.path() / "from-hotter", shaft, folder.path() / "hotter" / "result.hdf"), 0)
      << read_failure(folder.path() / "from-hotter").value_or(nlohmann::json()).dump();
  const auto plan = summary(folder.path() / "plan");
  const auto other = summary(folder.path() / "from-hotter");
  const auto hot = summary(folder.path() / "hotter");
  EXPECT_TRUE(plan["prediction"]["converged"].get<bool>());
  EXPECT_TRUE(other["prediction"]["converged"].get<bool>());
  const double mean = plan["mean_solid_temperature"];
  EXPECT_NEAR(other["mean_solid_temperature"].get<double>(), mean, 0.005 * mean);
  EXPECT_NEAR(other["cohesive_zone"]["height_mean"].get<double>(), plan["cohesive_zone"]["height_mean"].get<double>(),
              0.1);
  EXPECT_GT(hot["mean_solid_temperature"].get<double>(), mean + 20) << "more blast, hotter bed";
  EXPECT_LT(plan["ledger"]["energy"]["residual"].get<double>(), 1e-3);
  EXPECT_LT(plan["ledger"]["mass"]["residual"].get<double>(), 1e-9);
}

/// The DEM result that has a prediction's own motion, with noise on each component of the velocity (rms over the
/// speed).
void write_motion(const std::filesystem::path& file, const std::filesystem::path& prediction, double noise) {
  Task task;
  task.campaign = read_campaign_text(shaft, "").campaign;
  task.campaign_hash = hash_text("one furnace");
  const BedMesh mesh = BedMesh::read(prediction / "foam" / "mesh.hdf");
  const FieldFile result(prediction / "result.hdf", "tracer-result");
  cupola::testing::StatedBed bed = testing::bed_at_rest(mesh, task.campaign, expected_packing);
  bed.solids_fraction = result.cell_data("solids_fraction");
  const auto velocity = result.cell_data("solids_velocity", 3);
  std::mt19937 generator(1);
  const auto evenly = [&] { return std::sqrt(12.0) * (static_cast<double>(generator()) / 4294967296.0 - 0.5); };
  for (std::size_t c = 0; c < mesh.cells(); ++c) {
    const double* u = &velocity[3 * c];
    const double speed = std::hypot(u[0], u[1], u[2]);
    for (std::size_t k = 0; k < 3; ++k) bed.solids_velocity[c][k] = u[k] + noise * speed * evenly();
  }
  bed.coke_removal_rate = charge_of(task.campaign, expected_packing).mass_rate[0];
  bed.removal_by_raceway = {bed.coke_removal_rate / 2, bed.coke_removal_rate / 2};
  testing::write_stated_bed(file, mesh, task, bed);
}

TEST(Predictor, NoiseOfTheMotionIsSurvived) {
  const TemporaryFolder folder;
  const auto clean = folder.path() / "clean";
  ASSERT_EQ(predict(clean, shaft), 0);
  const double mean = summary(clean)["mean_solid_temperature"];
  for (const double noise : {0.0, 0.05, 0.2, 0.5}) {
    const auto here = folder.path() / std::to_string(noise);
    const auto motion = folder.path() / ("motion" + std::to_string(noise));
    write_motion(motion, clean, noise);
    ASSERT_EQ(predict(here, shaft, clean / "result.hdf", motion), 0)
        << read_failure(here).value_or(nlohmann::json()).dump();
    const auto result = summary(here);
    EXPECT_TRUE(result["prediction"]["converged"].get<bool>()) << noise;
    EXPECT_TRUE(result["prediction"]["with_dem"].get<bool>());
    EXPECT_LT(result["ledger"]["mass"]["residual"].get<double>(), 1e-9) << noise;
    EXPECT_LT(result["ledger"]["energy"]["residual"].get<double>(), 1e-3) << noise;
    EXPECT_NEAR(result["mean_solid_temperature"].get<double>(), mean, 0.05 * mean) << noise;
  }
}

/// A tracer result with the windows of a march that was hotter than a prediction by `offset`, K, and warmed by
/// `warming`, K/s.
void write_march(const std::filesystem::path& file, const std::filesystem::path& prediction, double offset,
                 double warming) {
  const BedMesh mesh = BedMesh::read(prediction / "foam" / "mesh.hdf");
  const FieldFile result(prediction / "result.hdf", "tracer-result");
  const Campaign campaign = read_campaign_text(shaft, "").campaign;
  constexpr int windows = 6;
  constexpr double passage = 600;  // s
  MarchWindows kept(campaign.species.size(), mesh.cells());
  const std::vector<double> fraction = result.cell_data("solids_fraction");
  for (int window = 0; window < windows; ++window) {
    CellContents contents;
    for (const Species& species : campaign.species) {
      std::vector<double> volume = result.cell_data("volume_share." + species.name);
      std::vector<double> temperature = result.cell_data("solids_temperature." + species.name);
      for (std::size_t c = 0; c < mesh.cells(); ++c) {
        const bool bed = mesh.cell_centre[c][2] < campaign.charging.stock_line;
        volume[c] *= bed ? fraction[c] * mesh.cell_volume[c] : 0;
        temperature[c] += offset + warming * passage * (window - 0.5 * windows);
      }
      contents.volume.push_back(volume);
      contents.temperature.push_back(temperature);
    }
    Averages averages(campaign.species.size(), mesh.cells(), true);
    averages.add(contents, campaign, passage);
    kept.add(averages);
  }
  const std::vector<std::int64_t> cell_points = result.cell_points();
  FieldFileWriter writer(file, {"tracer-result", hash_text("one furnace"), mesh.hash}, result.points(), cell_points);
  writer.summary(nlohmann::json::object());
  kept.write(writer.hdf());
  writer.commit();
}

/// What marches measure is known here, and so is what must come of it.
TEST(Correction, FindsAKnownBiasAndWhatWasStillToGo) {
  const TemporaryFolder folder;
  const auto first = folder.path() / "first";
  const auto motion = folder.path() / "motion.hdf";
  const auto prediction = folder.path() / "prediction";
  ASSERT_EQ(predict(first, shaft), 0);
  write_motion(motion, first, 0);
  ASSERT_EQ(predict(prediction, shaft, first / "result.hdf", motion), 0);
  const double mean = summary(prediction)["mean_solid_temperature"];
  const auto corrected = [&](const std::string& name, double offset, double warming) {
    const auto march = folder.path() / (name + ".hdf");
    write_march(march, prediction, offset, warming);
    const auto here = folder.path() / name;
    EXPECT_EQ(run(here, shaft, TaskKind::correct,
                  {{"granular", motion},
                   {"solids_temperature", first / "result.hdf"},
                   {"prediction", prediction / "result.hdf"},
                   {"march", march}}),
              0)
        << read_failure(here).value_or(nlohmann::json()).dump();
    return summary(here);
  };
  const auto offset = corrected("offset", 10, 0);
  EXPECT_NEAR(offset["correction"]["bias_mean"].get<double>(), 10, 1.5);
  EXPECT_NEAR(offset["correction"]["from_prediction_mean"].get<double>(), 10, 1e-6);
  EXPECT_LT(offset["correction"]["noise"].get<double>(), 1e-12);
  EXPECT_LT(offset["correction"]["to_go"].get<double>(), 2e-3);
  EXPECT_NEAR(offset["mean_solid_temperature"].get<double>(), mean + 10, 2.5)
      << "ore does not exceed its melting point";

  // A bed that warms by 20 K/h has still to get hotter, and one that cools to get colder.
  constexpr double rate = 20. / 3600;
  const auto warming = corrected("warming", 0, rate), cooling = corrected("cooling", 0, -rate);
  EXPECT_NEAR(warming["correction"]["tendency"].get<double>() * warming["correction"]["level"].get<double>(), 20, 0.5);
  EXPECT_GT(warming["correction"]["to_go"].get<double>(), 2e-3);
  EXPECT_GT(warming["mean_solid_temperature"].get<double>(), mean + 3);
  EXPECT_LT(cooling["mean_solid_temperature"].get<double>(), mean - 3);
}

struct Hard {
  std::string name, what, with;
};
class HardCases : public ::testing::TestWithParam<Hard> {};

/// Whatever the blast, there is an answer with closed balances, or a sentence that there is none.
TEST_P(HardCases, EndsWithAnAnswerOrSaysThatItHasNone) {
  const TemporaryFolder folder;
  ASSERT_EQ(predict(folder.path(),
                    replaced(shaft, GetParam().what, GetParam().with, GetParam().name == "asymmetric" ? false : true)),
            0);
  const auto result = summary(folder.path());
  const auto& prediction = result["prediction"];
  EXPECT_TRUE(prediction["converged"].get<bool>() || !prediction["warnings"].empty());
  EXPECT_LT(result["ledger"]["mass"]["residual"].get<double>(), 1e-9);
  EXPECT_LT(result["ledger"]["energy"]["residual"].get<double>(), 2e-2);
  if (GetParam().name == "weak_blast") {
    EXPECT_FALSE(prediction["warnings"].empty()) << "ore that does not melt is named";
  }
}

INSTANTIATE_TEST_SUITE_P(Blasts, HardCases,
                         ::testing::Values(Hard{"weak_blast", "0.85 kg/s", "0.3 kg/s"},
                                           Hard{"strong_blast", "0.85 kg/s", "1.4 kg/s"},
                                           Hard{"asymmetric", "0.85 kg/s", "0.6 kg/s"},
                                           Hard{"no_ore", ", {ore: 780 kg}", ""}),
                         [](const auto& info) { return info.param.name; });

TEST(Predictor, ABedWithoutRacewaysIsRefused) {
  const TemporaryFolder folder;
  std::string text = moving_bed;
  const std::size_t at = text.find("raceways:");
  text.erase(at, text.find('\n', at) - at);
  EXPECT_NE(predict(folder.path(), text), 0);
  const auto failure = read_failure(folder.path());
  ASSERT_TRUE(failure);
  EXPECT_NE(failure->value("sentence", "").find("raceways"), std::string::npos);
}

/// What is odd about a furnace is named, with what its user can change.
TEST(Predictor, OddFurnacesAreNamedWithACure) {
  const TemporaryFolder folder;
  const auto warnings = [&](const std::string& name, const std::string& text) {
    EXPECT_EQ(predict(folder.path() / name, text), 0)
        << read_failure(folder.path() / name).value_or(nlohmann::json()).dump();
    return summary(folder.path() / name)["prediction"]["warnings"].dump();
  };
  EXPECT_THAT(
      warnings("zone", replaced(replaced(shaft, "0.85 kg/s", "4 kg/s"), "nusselt_factor: 0.1", "nusselt_factor: 1")),
      ::testing::AllOf(::testing::HasSubstr("reaches the stock line"), ::testing::HasSubstr("Blow less")));
  EXPECT_THAT(warnings("hearth", replaced(shaft, "[-0.5, 2.0]", "[-6.5, 2.0]")),
              ::testing::AllOf(::testing::HasSubstr("No path leads from the stock plane to"),
                               ::testing::HasSubstr("let the mesh begin higher")));
}

}  // namespace
}  // namespace cupola
