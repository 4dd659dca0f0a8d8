#include "orchestrator/measured_rates.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>

#include "schemas/files.hpp"
#include "tests/support/temporary_folder.hpp"

namespace cupola {
namespace {

using nlohmann::json;
using ::testing::HasSubstr;

/// A report with one episode of which the DEM stage has finished.
json report_of_a_dem_stage(int episode, double wall) {
  return {{"campaign_hash", "xxh3:1"},
          {"started", "2030-01-01T00:00:00Z"},
          {"episodes",
           {{{"index", episode},
             {"dem",
              {{"state", "finished"},
               {"ranks", 2},
               {"cells", 100},
               {"parcels", 1000},
               {"process_seconds", 0.5},
               {"time_step", 1e-4},
               {"wall_seconds_by_part", {{"liggghts", wall}}}}},
             {"tracer", nullptr}}}}};
}

/// The same of a tracer stage: 100 cells, 50 steps, one rank.
json report_of_a_tracer_stage(const std::string& gas_model, double flow) {
  return {{"campaign_hash", "xxh3:" + gas_model},
          {"started", "2030-01-01T00:00:00Z"},
          {"episodes",
           {{{"index", 1},
             {"dem", nullptr},
             {"tracer",
              {{"state", "finished"},
               {"ranks", 1},
               {"cells", 100},
               {"tracers", 1000},
               {"steps", 50},
               {"gas_model", gas_model},
               {"wall_seconds_by_part", {{"flow", flow}}}}}}}}};
}

class MeasuredRates : public ::testing::Test {
 protected:
  TemporaryFolder folder_;
  std::filesystem::path file_ = folder_.path() / "cache" / "rates.json";
};

TEST_F(MeasuredRates, AreBuiltInUntilSomethingHasBeenRun) {
  EXPECT_EQ(measured_rates(file_).contacts, Rates{}.contacts);
  EXPECT_THAT(measured_rates(file_).basis, HasSubstr("nothing has been measured"));
  EXPECT_EQ(measured_rates(std::nullopt).basis, Rates{}.basis);
}

TEST_F(MeasuredRates, AreWorkOverCoreSecondsAndEveryStageCountsOnce) {
  // 1000 parcels x 5000 steps on two ranks in 10 s, then as much in 30 s.
  remember_rates(report_of_a_dem_stage(1, 10), file_);
  EXPECT_NEAR(measured_rates(file_).contacts, 2 * 10 / 5e6, 1e-12);
  remember_rates(report_of_a_dem_stage(1, 10), file_);
  remember_rates(report_of_a_dem_stage(2, 30), file_);
  EXPECT_NEAR(measured_rates(file_).contacts, 2 * 40 / 1e7, 1e-12);
  EXPECT_THAT(measured_rates(file_).basis, HasSubstr("in 2 stages"));
  EXPECT_EQ(measured_rates(file_).motion, Rates{}.motion) << "no tracer stage has been run";
}

TEST_F(MeasuredRates, EachGasModelHasItsOwn) {
  remember_rates(report_of_a_tracer_stage("darcy-forchheimer", 1), file_);
  remember_rates(report_of_a_tracer_stage("navier-stokes", 7), file_);
  EXPECT_NEAR(measured_rates(file_).gas_flow, 1 / 5e3, 1e-12);
  EXPECT_NEAR(measured_rates(file_).gas_flow_navier_stokes, 7 / 5e3, 1e-12);
}

TEST_F(MeasuredRates, ADamagedFileIsBegunAnew) {
  std::filesystem::create_directories(file_.parent_path());
  std::ofstream(file_) << "{ torn";
  EXPECT_EQ(measured_rates(file_).contacts, Rates{}.contacts);
  remember_rates(report_of_a_dem_stage(1, 10), file_);
  EXPECT_NE(measured_rates(file_).contacts, Rates{}.contacts);
}

}  // namespace
}  // namespace cupola
