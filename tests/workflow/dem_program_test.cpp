// The program cupola-dem as the orchestrator uses it: prepare, run under mpirun, stop, go on.
#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include <chrono>
#include <cmath>
#include <csignal>
#include <functional>
#include <numeric>
#include <optional>
#include <thread>

#include "schemas/campaign_reader.hpp"
#include "schemas/field_file.hpp"
#include "schemas/files.hpp"
#include "schemas/task.hpp"
#include "schemas/version.hpp"
#include "tests/support/child_process.hpp"
#include "tests/support/temporary_folder.hpp"

namespace cupola {
namespace {

/// Its exit status where it has ended.
std::optional<int> ended(pid_t child) {
  int status = 0;
  if (waitpid(child, &status, WNOHANG) == 0) return std::nullopt;
  return exit_status(status);
}

std::vector<std::string> stage_command(const std::filesystem::path& folder, int ranks) {
  return {CUPOLA_MPIEXEC, "--oversubscribe",     "--bind-to", "none",
          "-n",           std::to_string(ranks), CUPOLA_DEM,  folder.string()};
}

Task tiny_task(int ranks, DemSettings::GasModel gas = DemSettings::GasModel::quasi_steady) {
  Task task;
  task.kind = TaskKind::dem;
  task.campaign = load_campaign(CUPOLA_TINY);
  task.campaign.launch.ranks = ranks;
  task.campaign.dem.gas = gas;
  const bool transient = gas == DemSettings::GasModel::transient;
  if (transient) task.campaign.dead_man = DeadMan{0.4, 1};
  if (transient) task.campaign.dem.transient.turbulence = TransientGas::Turbulence::realizable_k_epsilon;
  task.campaign.dem.relaxation = 0.1;
  task.campaign.dem.window = transient ? 0.1 : 0.3;  // its steps are short
  task.campaign.charging.stock_line = 1.6;
  task.campaign_hash = hash_text("tiny");
  task.program_version = program_version;
  task.random_seed = 11;
  return task;
}

void prepare_task(const std::filesystem::path& folder, const Task& task) {
  std::filesystem::create_directories(folder);
  write_task(folder, task);
  ASSERT_EQ(wait_for(start({CUPOLA_DEM, "prepare", folder.string()})), 0);
}

double sum(const std::vector<double>& values) { return std::accumulate(values.begin(), values.end(), 0.0); }

/// What must hold of any result.
void check_result(const std::filesystem::path& folder, const Task& task) {
  verify_manifest(folder);
  const FieldFile result(folder / "result.hdf", "dem-result");
  const auto summary = result.summary();
  EXPECT_LT(std::abs(summary.at("ledger").at("residual").get<double>()), 1e-13);
  const bool transient = task.campaign.dem.gas == DemSettings::GasModel::transient;
  // The transient gas's first steps give next to no drag: what they leave of the balance is over that.
  EXPECT_LT(summary.at("momentum_residual").get<double>(), transient ? 1e-6 : 1e-12);
  EXPECT_GT(summary.at("packing_fraction").get<double>(), 0.4);
  EXPECT_LT(summary.at("packing_fraction").get<double>(), 0.75);
  EXPECT_NEAR(summary.at("window_seconds").get<double>(), task.campaign.dem.window, 1e-9);
  EXPECT_GT(summary.at("coke_removal_rate").get<double>(), 0);

  // The material volume of all parcels that are in the mesh is in the species' fractions.
  const HdfReader& file = result.hdf();
  const HdfReader mesh(folder / "foam" / "mesh.hdf");
  const auto volume = mesh.doubles("Mesh/cell_volume");
  double on_mesh = 0;
  for (const auto& species : task.campaign.species) {
    const auto fraction = result.cell_data("solids_fraction." + species.name);
    for (std::size_t cell = 0; cell < volume.size(); ++cell) on_mesh += fraction[cell] * volume[cell];
  }
  const auto species = file.integers("Packing/species");
  const auto mass = file.doubles("Packing/mass");
  const auto position = file.doubles("Packing/position");
  double of_parcels = 0;
  for (std::size_t i = 0; i < mass.size(); ++i)
    if (position[3 * i + 2] < task.campaign.top())
      of_parcels += mass[i] / task.campaign.species[static_cast<std::size_t>(species[i])].density;
  EXPECT_NEAR(on_mesh, of_parcels, 1e-12 * of_parcels);
  EXPECT_NEAR(sum(mass), summary.at("ledger").at("mass_stored").get<double>(), 1e-9);
  for (const double value : result.cell_data("solids_velocity", 3)) EXPECT_TRUE(std::isfinite(value));
}

void expect_same_results(const std::filesystem::path& one, const std::filesystem::path& other) {
  const FieldFile a(one / "result.hdf", "dem-result");
  const FieldFile b(other / "result.hdf", "dem-result");
  EXPECT_EQ(a.hdf().integers("Packing/id"), b.hdf().integers("Packing/id"));
  for (const char* name : {"position", "velocity", "angular_velocity", "radius"})
    EXPECT_EQ(a.hdf().doubles(std::string("Packing/") + name), b.hdf().doubles(std::string("Packing/") + name)) << name;
  for (const char* name : {"solids_fraction", "solids_fraction_error", "contact_fraction", "gas_pressure"})
    EXPECT_EQ(a.cell_data(name), b.cell_data(name)) << name;
  for (const char* name : {"solids_velocity", "solids_velocity_error", "gas_velocity"})
    EXPECT_EQ(a.cell_data(name, 3), b.cell_data(name, 3)) << name;
}

/// What happened, without how long it took.
std::vector<nlohmann::json> history_of(const std::filesystem::path& folder) {
  std::vector<nlohmann::json> history = read_history(folder);
  for (nlohmann::json& line : history) line.erase("wall_seconds");
  return history;
}

class DemProgram : public testing::TestWithParam<std::pair<int, DemSettings::GasModel>> {};

TEST_P(DemProgram, RunsStopsAndGoesOnAsIfNothingHadHappened) {
  const TemporaryFolder temporary;
  const auto& [ranks, gas] = GetParam();
  const Task task = tiny_task(ranks, gas);
  const auto undisturbed = temporary.path() / "undisturbed";
  prepare_task(undisturbed, task);
  ASSERT_EQ(wait_for(start(stage_command(undisturbed, ranks))), 0) << read_text(undisturbed / "stage.log");
  check_result(undisturbed, task);

  const auto stopped = temporary.path() / "stopped";
  prepare_task(stopped, task);
  // Once while the bed is poured, once in the window.
  int stops = 0;
  for (const std::string phase : {"building", "averaging"}) {
    const pid_t child = start(stage_command(stopped, ranks));
    std::optional<int> code;
    while (!(code = ended(child))) {
      const auto progress = read_progress(stopped);
      const auto history = read_history(stopped);
      const bool there = phase == "building" ? progress && progress->phase == phase
                                             : !history.empty() && history.back().at("phase") == phase;
      if (there) break;
      std::this_thread::sleep_for(std::chrono::milliseconds(10));
    }
    if (!code) {
      kill(child, SIGUSR1);
      code = wait_for(child);
    }
    EXPECT_TRUE(*code == 75 || *code == 0) << "exit status " << *code;
    EXPECT_EQ(has_manifest(stopped), *code == 0);
    if (*code == 0) break;
    ++stops;
  }
  EXPECT_GE(stops, 1) << "the stage was never caught running";
  ASSERT_EQ(wait_for(start(stage_command(stopped, ranks))), 0) << read_text(stopped / "stage.log");
  expect_same_results(undisturbed, stopped);
  EXPECT_EQ(history_of(undisturbed), history_of(stopped));

  // The next episode starts from this packing.
  Task next = task;
  next.episode = 2;
  next.inputs["packing"] = {"../undisturbed/result.hdf", hash_file(undisturbed / "result.hdf")};
  const auto second = temporary.path() / "second";
  prepare_task(second, next);
  ASSERT_EQ(wait_for(start(stage_command(second, ranks))), 0) << read_text(second / "stage.log");
  check_result(second, next);
}

INSTANTIATE_TEST_SUITE_P(Ranks, DemProgram,
                         testing::Values(std::pair{1, DemSettings::GasModel::quasi_steady},
                                         std::pair{2, DemSettings::GasModel::quasi_steady},
                                         std::pair{1, DemSettings::GasModel::transient}));

TEST(DemProgram, ABedThatIsTakenAwayEndsWithAdvice) {
  const TemporaryFolder temporary;
  Task task = tiny_task(1);
  for (Raceway& raceway : task.campaign.raceways) {
    raceway.box = {Vector3{-0.4, -0.2, 0}, Vector3{0.4, 0.2, task.campaign.top()}};
    raceway.dem_removal_rate = 1e6;
  }
  prepare_task(temporary.path(), task);
  EXPECT_EQ(wait_for(start(stage_command(temporary.path(), 1))), 70);
  const auto failure = read_failure(temporary.path());
  ASSERT_TRUE(failure);
  EXPECT_NE(failure->at("sentence").get<std::string>().find("no parcel is left"), std::string::npos) << *failure;
  EXPECT_FALSE(std::filesystem::exists(temporary.path() / "result.hdf"));
}

/// A packing handed over as a stage writes it, of three parcels of coke in a row that `spoil` puts elsewhere.
std::filesystem::path write_packing(const std::filesystem::path& folder, const Task& task,
                                    const std::function<void(std::vector<double>& position)>& spoil) {
  const FieldFile mesh(folder / "foam" / "mesh.hdf", "mesh");
  const auto file = folder / "spoilt.hdf";
  FieldFileWriter writer(file, {"dem-result", task.campaign_hash, hash_file(folder / "foam" / "mesh.hdf")},
                         mesh.points(), mesh.cell_points());
  const double radius = task.campaign.species[0].parcel_diameter() / 2;
  const double mass = task.campaign.species[0].density * 4 / 3 * M_PI * std::pow(radius, 3);
  std::vector<double> position{-0.2, 0, 0.5, 0, 0, 0.5, 0.2, 0, 0.5};
  spoil(position);
  writer.hdf().write("Packing/id", std::vector<std::int64_t>{1, 2, 3});
  writer.hdf().write("Packing/species", std::vector<std::int64_t>{0, 0, 0});
  writer.hdf().write("Packing/released", std::vector<std::int64_t>{1, 1, 1});
  writer.hdf().write("Packing/radius", std::vector<double>(3, radius));
  writer.hdf().write("Packing/mass", std::vector<double>(3, mass));
  writer.hdf().write("Packing/position", position, 3);
  for (const char* name : {"Packing/velocity", "Packing/angular_velocity"})
    writer.hdf().write(name, std::vector<double>(9, 0), 3);
  writer.hdf().write("Charging/next_layer", std::vector<std::int64_t>{0});
  for (const char* name : {"Charging/owed", "Charging/carried"})
    writer.hdf().write(name, std::vector<double>(task.campaign.species.size(), 0));
  writer.commit();
  return file;
}

TEST(DemProgram, APackingThatCannotBeIsRefusedBeforeAnythingMoves) {
  const TemporaryFolder temporary;
  Task task = tiny_task(1);
  prepare_task(temporary.path(), task);
  // What else is refused: PackingCheck in unit/dem/test_parts.cpp.
  const std::vector<std::pair<std::string, std::function<void(std::vector<double>&)>>> spoilt{
      {"parcel 1 overlaps parcel 2 by 1.", [](std::vector<double>& position) { position[3] = -0.15; }},
      {"parcel 3 lies outside the furnace, at 0.7 0 0.5 m", [](std::vector<double>& position) { position[6] = 0.7; }}};
  for (const auto& [sentence, spoil] : spoilt) {
    const auto file = write_packing(temporary.path(), task, spoil);
    task.inputs["packing"] = {file.string(), hash_file(file)};
    write_task(temporary.path(), task);
    EXPECT_EQ(wait_for(start(stage_command(temporary.path(), 1))), 65) << sentence;
    const auto failure = read_failure(temporary.path());
    ASSERT_TRUE(failure) << sentence;
    EXPECT_NE(failure->at("sentence").get<std::string>().find(sentence), std::string::npos) << *failure;
    EXPECT_FALSE(std::filesystem::exists(temporary.path() / "result.hdf"));
  }
}

TEST(DemProgram, AWallWithAHoleIsRefused) {
  const TemporaryFolder temporary;
  prepare_task(temporary.path(), tiny_task(1));
  const auto walls = temporary.path() / "foam" / "wall.stl";
  std::string text = read_text(walls);
  const auto begin = text.find("facet normal", text.size() / 2);
  text.erase(begin, text.find("endfacet", begin) + 9 - begin);
  write_text_atomically(walls, text);
  EXPECT_EQ(wait_for(start(stage_command(temporary.path(), 1))), 65);
  const auto failure = read_failure(temporary.path());
  ASSERT_TRUE(failure);
  EXPECT_NE(failure->at("sentence").get<std::string>().find("the wall has a hole at"), std::string::npos) << *failure;
}

TEST(DemProgram, AWrongTaskIsRefused) {
  const TemporaryFolder temporary;
  EXPECT_EQ(wait_for(start({CUPOLA_DEM, (temporary.path() / "nowhere").string()})), 65);
  Task task = tiny_task(1);
  task.kind = TaskKind::tracer;
  write_task(temporary.path(), task);
  EXPECT_EQ(wait_for(start({CUPOLA_DEM, temporary.path().string()})), 65);
  EXPECT_TRUE(read_failure(temporary.path()));
}

}  // namespace
}  // namespace cupola
