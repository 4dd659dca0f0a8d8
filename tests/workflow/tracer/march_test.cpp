#include <gtest/gtest.h>
#include <signal.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <thread>

#include "schemas/campaign_reader.hpp"
#include "schemas/field_file.hpp"
#include "schemas/files.hpp"
#include "schemas/task.hpp"
#include "tests/support/tracer_program.hpp"

/// The tracer stage as a program, on a generated bed in the tiny slot.
namespace cupola {
namespace {

Campaign tiny() {
  Campaign campaign = load_campaign(std::filesystem::path(CUPOLA_SOURCE_DIR) / "cases" / "tiny" / "campaign.yaml");
  campaign.tracer.duration = 600;
  return campaign;
}

Campaign cold() {
  Campaign campaign = tiny();
  campaign.heat.reset();
  campaign.scene.heat_loss.reset();
  campaign.initial.cohesive_zone.reset();
  for (Species& species : campaign.species) {
    species.softening.reset();
    species.none_below = 0;
  }
  return campaign;
}

using TracerTask = testing::TracerProgram;

TEST(TracerStage, MarchesAndClosesItsBalances) {
  const TracerTask task(tiny());
  ASSERT_EQ(task.run(), 0);
  EXPECT_TRUE(has_manifest(task.path()));
  verify_manifest(task.path());
  const FieldFile result = task.result();
  const nlohmann::json summary = result.summary();
  EXPECT_LT(summary["ledger"]["mass"]["residual"].get<double>(), 1e-12);
  EXPECT_LT(summary["ledger"]["energy"]["residual"].get<double>(), 1e-6);
  EXPECT_GT(summary["ledger"]["mass"]["in"].get<double>(), 0);
  EXPECT_GT(summary["ledger"]["mass"]["out"]["raceway"].get<double>(), 0);
  EXPECT_EQ(summary["ledger"]["mass"]["out"]["lost"].get<double>(), 0);
  EXPECT_GT(summary["ledger"]["energy"]["blast"].get<double>(), 0);
  EXPECT_NEAR(summary["scale"].get<double>(), 0.01, 1e-4);
  EXPECT_LT(std::abs(summary["scale_check"].get<double>()), 0.1);
  EXPECT_GT(summary["tracers"].get<double>(), summary["cells"].get<double>());
  EXPECT_EQ(summary["energy_solves"].get<long>() >= summary["steps"].get<long>(), true);
  for (const char* field : {"solids_temperature", "solids_temperature.ore", "solids_temperature.coke",
                            "ore_temperature", "gas_temperature"}) {
    for (const double value : result.cell_data(field)) {
      ASSERT_GE(value, 290) << field;
      ASSERT_LE(value, 2450) << field;
    }
  }
  const auto history = read_history(task.path());
  ASSERT_FALSE(history.empty());
  EXPECT_EQ(history.back()["step"].get<long>(), summary["steps"].get<long>());
  const auto progress = read_progress(task.path());
  ASSERT_TRUE(progress.has_value());
  EXPECT_DOUBLE_EQ(progress->process_seconds, 600);
}

TEST(TracerStage, TwoRanksCarryTheSameTracers) {
  const TracerTask one(tiny(), 1);
  const TracerTask two(tiny(), 2);
  ASSERT_EQ(one.run(), 0);
  ASSERT_EQ(two.run(), 0);
  const testing::FinalTracers a = one.tracers();
  const testing::FinalTracers b = two.tracers();
  ASSERT_EQ(a.id, b.id);
  double position = 0;
  double temperature = 0;
  for (std::size_t i = 0; i < a.position.size(); ++i) {
    for (std::size_t k = 0; k < 3; ++k) position = std::max(position, std::abs(a.position[i][k] - b.position[i][k]));
  }
  for (std::size_t i = 0; i < a.id.size(); ++i)
    temperature = std::max(temperature, std::abs(a.temperature[i] - b.temperature[i]));
  EXPECT_LT(position, 1e-7);     // the projection's linear solver stops at its tolerance
  EXPECT_LT(temperature, 1e-2);  // so do flow and energy
}

TEST(TracerStage, StoppedAndResumedEqualsUndisturbed) {
  Campaign campaign = tiny();
  campaign.tracer.time_step = 0.5;  // long enough to be stopped on the way
  const TracerTask undisturbed(campaign);
  const TracerTask stopped(campaign);
  ASSERT_EQ(undisturbed.run(), 0);
  const pid_t child = stopped.start();
  // Ask as soon as the march shows progress.
  for (int k = 0; k < 3000 && !read_progress(stopped.path()); ++k)
    std::this_thread::sleep_for(std::chrono::milliseconds(20));
  kill(child, SIGUSR1);
  ASSERT_EQ(TracerTask::wait(child), 75);
  EXPECT_FALSE(has_manifest(stopped.path()));
  ASSERT_EQ(stopped.run(), 0);
  const testing::FinalTracers a = undisturbed.tracers();
  const testing::FinalTracers b = stopped.tracers();
  ASSERT_EQ(a.id, b.id);
  EXPECT_EQ(a.position, b.position);
  EXPECT_EQ(a.temperature, b.temperature);
  EXPECT_EQ(read_history(undisturbed.path()).size(), read_history(stopped.path()).size());
}

TEST(TracerStage, ColdSceneHasNoTemperatures) {
  const TracerTask task(cold());
  ASSERT_EQ(task.run(), 0);
  const FieldFile result = task.result();
  EXPECT_FALSE(result.has_cell_data("solids_temperature"));
  EXPECT_FALSE(result.has_cell_data("gas_temperature"));
  EXPECT_FALSE(result.hdf().has("Tracers/temperature"));
  EXPECT_TRUE(result.has_cell_data("volume_share.ore"));
  EXPECT_LT(result.summary()["ledger"]["mass"]["residual"].get<double>(), 1e-12);
  EXPECT_EQ(result.summary()["energy_solves"].get<long>(), 0);
}

TEST(TracerStage, RandomDisplacementAndRawFieldKeepTheBalances) {
  for (const bool displaced : {true, false}) {
    Campaign campaign = tiny();
    campaign.tracer.clean_field = displaced;
    if (displaced) campaign.tracer.displacement = TracerSettings::Displacement::random;
    const TracerTask task(campaign);
    ASSERT_EQ(task.run(), 0);
    const nlohmann::json ledger = task.result().summary()["ledger"];
    EXPECT_LT(ledger["mass"]["residual"].get<double>(), 1e-12);
    EXPECT_LT(ledger["energy"]["residual"].get<double>(), 1e-6);
    EXPECT_EQ(ledger["mass"]["out"]["lost"].get<double>(), 0);
  }
}

TEST(TracerStage, RefusesAGranularFieldOfAnotherMesh) {
  Campaign coarse = tiny();
  coarse.scene.mesh.cell = 0.2;
  const TracerTask other(coarse);
  const TracerTask task(tiny());
  std::filesystem::copy_file(other.path() / "granular.hdf", task.path() / "granular.hdf",
                             std::filesystem::copy_options::overwrite_existing);
  Task wrong = read_task(other.path());
  wrong.campaign = tiny();
  write_task(task.path(), wrong);
  EXPECT_EQ(task.run(), 65);
  EXPECT_TRUE(read_failure(task.path()).has_value());
  EXPECT_FALSE(std::filesystem::exists(task.path() / "result.hdf"));
}

}  // namespace
}  // namespace cupola
