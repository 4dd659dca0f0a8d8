#include <gmock/gmock.h>

#include "orchestrator/report/warnings.hpp"

namespace cupola {
namespace {

using testing::AllOf;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

nlohmann::json quiet_report() {
  return {{"results", nlohmann::json::array()},
          {"retries", nlohmann::json::array()},
          {"episodes",
           {{{"index", 1},
             {"dem", {{"starved_seconds", 0}, {"fast_parcels", 0}}},
             {"tracer",
              {{"scale_check", -0.04},
               {"inlets", {{{"name", "tuyere-left"}, {"mach", 0.2}}}},
               {"energy_residual", 1e-3},
               {"clamps", {{"void_fraction_cells", 0}}},
               {"ledger", {{"mass", {{"in", 1000.}, {"out", {{"unmelted", 0.}}}}}}}}}}}}};
}

TEST(Warnings, AGoodRunHasNone) { EXPECT_THAT(warnings(quiet_report()), IsEmpty()); }

TEST(Warnings, UnmeltedOreOfTheLastEpisodeIsNamedWithItsShare) {
  nlohmann::json report = quiet_report();
  report["episodes"][0]["tracer"]["ledger"]["mass"]["out"]["unmelted"] = 120.;
  EXPECT_THAT(warnings(report),
              ElementsAre(AllOf(HasSubstr("12 % of the charge of episode 1"), HasSubstr("heat balance"))));
  report["episodes"].push_back(quiet_report()["episodes"][0]);
  EXPECT_THAT(warnings(report), IsEmpty()) << "the way there does not count";
}

TEST(Warnings, EachLimitIsTold) {
  nlohmann::json report = quiet_report();
  report["episodes"][0]["tracer"]["clamps"]["void_fraction_cells"] = 7;
  EXPECT_THAT(warnings(report), ElementsAre(HasSubstr("in 7 cells the bed is denser")));
  report = quiet_report();
  report["episodes"][0]["tracer"]["clamps"]["hot_gas"] = 3;
  EXPECT_THAT(warnings(report), ElementsAre(HasSubstr("limit of the model was met: hot gas (3)")));
  report = quiet_report();
  report["episodes"][0]["dem"]["starved_seconds"] = 1.5;
  EXPECT_THAT(warnings(report), ElementsAre(HasSubstr("Starvation: in DEM stage 1")));
  report = quiet_report();
  report["episodes"][0]["tracer"]["energy_residual"] = 0.02;
  EXPECT_THAT(warnings(report), ElementsAre(HasSubstr("2 % of the blast's heat")));
  report = quiet_report();
  report["episodes"][0]["tracer"]["scale_check"] = 0.3;
  EXPECT_THAT(warnings(report), ElementsAre(HasSubstr("differs by 30 %")));
  report = quiet_report();
  report["episodes"][0]["tracer"]["inlets"][0]["mach"] = 0.45;
  EXPECT_THAT(warnings(report), ElementsAre(HasSubstr("tuyere-left at Mach 0.45")));
}

TEST(Warnings, GrainsThatAreNotAtOneTemperatureAreNamed) {
  nlohmann::json report = quiet_report();
  report["episodes"][0]["tracer"]["biot_largest"] = {{"coke", 0.25}, {"ore", 0.01}};
  EXPECT_THAT(warnings(report), ElementsAre(AllOf(HasSubstr("Biot number of coke reaches 0.25"))));
  report["episodes"][0]["tracer"]["intragrain_resistance"] = true;
  EXPECT_THAT(warnings(report), IsEmpty());
}

TEST(Warnings, GasModelsAreComparedByDistance) {
  nlohmann::json report = quiet_report();
  auto& compared = report["episodes"][0]["tracer"]["gas_models"];
  compared["rows"] = {{{"from", 0}, {"to", 0.5}, {"mass_flux", 0.9}, {"pressure", 0.04}},
                      {{"from", 2.5}, {"to", nullptr}, {"mass_flux", 0.003}, {"pressure", 0.001}}};
  EXPECT_THAT(warnings(report), ElementsAre(HasSubstr("0.0 to 0.5 m of an inlet: mass flux differs by 90 %"),
                                            HasSubstr("beyond 2.5 m of an inlet: mass flux differs by 0.3 %")));
  compared = {{"failed", "the gas would be too fast"}};
  EXPECT_THAT(warnings(report), ElementsAre(HasSubstr("could not be compared: the gas would be too fast")));
}

TEST(Warnings, FailedStagesAndRetriesComeFirst) {
  nlohmann::json report = quiet_report();
  report["results"].push_back({{"stage", "DEM"}, {"episode", 2}, {"state", "failed"}, {"sentence", "parcel 7 left"}});
  report["retries"].push_back("tried again");
  EXPECT_THAT(warnings(report), ElementsAre("DEM stage 2: failed: parcel 7 left", "tried again"));
}

TEST(Warnings, MissingNumbersAreNoWarnings) {
  nlohmann::json report = quiet_report();
  report["episodes"] = {{{"index", 1}, {"dem", {{"state", "running"}}}, {"tracer", nullptr}}};
  EXPECT_THAT(warnings(report), IsEmpty());
}

}  // namespace
}  // namespace cupola
