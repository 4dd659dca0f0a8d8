#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <functional>

#include "orchestrator/report/accuracy.hpp"
#include "orchestrator/study/campaign_key.hpp"
#include "orchestrator/study/data_table.hpp"
#include "orchestrator/study/pareto.hpp"
#include "orchestrator/study/study_array.hpp"
#include "orchestrator/study/study_fields.hpp"
#include "orchestrator/study/study_tasks.hpp"
#include "schemas/failure.hpp"
#include "tests/support/temporary_folder.hpp"

namespace cupola {
namespace {

using ::testing::AllOf;
using ::testing::Contains;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
namespace fs = std::filesystem;

const fs::path tiny = fs::path(CUPOLA_SOURCE_DIR) / "cases" / "tiny" / "campaign.yaml";

class StudyFile : public ::testing::Test {
 protected:
  ReadStudy read(const std::string& text, StudySize size = StudySize::full) {
    std::ofstream(file()) << text;
    return read_study(file(), size);
  }
  [[nodiscard]] fs::path file() const { return folder_.path() / "study.yaml"; }
  /// A study over the tiny slot with these lines in place of the usual ones.
  static std::string study(const std::string& vary, const std::string& reference, const std::string& more = "",
                           const std::string& stage = "tracer", const std::string& metrics = "[temperature]") {
    return "study: try\nscene: " + tiny.string() + "\nstage: " + stage + "\n" + more + "vary:\n" + vary +
           "reference:\n" + reference + "metrics: " + metrics + "\n";
  }
  /// Its errors, one a line.
  std::string errors(const std::string& text) { return to_text(read(text).errors); }

  TemporaryFolder folder_;
};

const std::string steps = "  - tracer.time_step: [10 s, 50 s]\n";
const std::string first = "  setting: {tracer.time_step: 10 s}\n";

TEST_F(StudyFile, AllCombinationsOfTheAxesWithTheirReferences) {
  const ReadStudy read = this->read(study(steps + "  - tracer.gas: [darcy-forchheimer, navier-stokes]\n", first));
  ASSERT_TRUE(read.ok()) << to_text(read.errors);
  ASSERT_EQ(read.study.settings.size(), 4U);
  EXPECT_EQ(read.study.settings[3].label(), "tracer.time_step = 50 s, tracer.gas = navier-stokes");
  EXPECT_EQ(read.study.settings[3].campaign.tracer.time_step, 50);
  // What the reference does not name is as in the setting itself.
  EXPECT_EQ(read.study.settings[3].reference, 1U);
  EXPECT_EQ(read.study.settings[2].reference, 0U);
  EXPECT_THAT(read.study.reference.sentence, HasSubstr("each with its own tracer.gas"));
}

TEST_F(StudyFile, KeysOfOneAxisChangeTogetherAndRangesAreSpelledOut) {
  const ReadStudy read =
      this->read(study("  - species.coke.coarse_graining: [2, 3]\n    species.ore.coarse_graining: [5, 8]\n"
                       "  - tracer.time_step: {from: 1 s, to: 100 s, points: 3, spacing: logarithmic}\n",
                       "  setting: {tracer.time_step: 1 s}\n", "", "episode"));
  ASSERT_TRUE(read.ok()) << to_text(read.errors);
  ASSERT_EQ(read.study.settings.size(), 6U);
  EXPECT_EQ(read.study.settings[1].campaign.tracer.time_step, 10);
  EXPECT_EQ(read.study.settings[5].campaign.species[0].coarse_graining, 3);
  EXPECT_EQ(read.study.settings[5].campaign.species[1].coarse_graining, 8);
}

TEST_F(StudyFile, EveryWrongThingIsNamedWithItsPlace) {
  const std::string said =
      errors(study("  - tracer.timestep: [1 s]\n  - tracer.time_step: [10 s, -1 s, 10 s]\n  - tracer.gas: [darcy]\n"
                   "  - species.cokes.density: [800]\n  - raceways[2].dem_removal_rate: [1]\n  - time_step: [1 s]\n",
                   "  setting: {tracer.accuracy: 1 %}\n"));
  EXPECT_THAT(said, HasSubstr(":5:5: vary[0].tracer.timestep: a campaign has no key `timestep` in `tracer` (did you "
                              "mean `time_step`?)"));
  EXPECT_THAT(said, HasSubstr(":6:30: vary[1].tracer.time_step[1]: must be greater than 0, but is -1 s"));
  EXPECT_THAT(said, HasSubstr("vary[1].tracer.time_step[2]: stands in this list already"));
  EXPECT_THAT(said, HasSubstr(":7:18: vary[2].tracer.gas[0]: expected one of none, darcy-forchheimer, navier-stokes"));
  EXPECT_THAT(said, HasSubstr("the scene has no `cokes` in `species` (did you mean `coke`?)"));
  EXPECT_THAT(said, HasSubstr("the scene has 2 of `raceways`, counted from 0: there is no [2]"));
  EXPECT_THAT(said, HasSubstr("a campaign has no key `time_step` (did you mean `dem.time_step` or "
                              "`dem.transient.time_step` or `tracer.time_step`?)"));
  EXPECT_THAT(said, HasSubstr("reference.setting.tracer.accuracy: `tracer.accuracy` is not varied in this study"));
}

TEST_F(StudyFile, ReferencesAndMetricsThatAreNotThere) {
  EXPECT_THAT(errors(study(steps, "  setting: {tracer.time_step: 20 s}\n")),
              HasSubstr("not among the values of `tracer.time_step`: \"10 s\", \"50 s\""));
  EXPECT_THAT(errors(study(steps, "  run: nowhere\n")), HasSubstr("reference.run: "));
  EXPECT_THAT(errors(study(steps, "  data: {temperature: none.csv}\n")), HasSubstr("there is no such file"));
  EXPECT_THAT(errors(study(steps, "  analytic: counter-current-bed\n")), HasSubstr("has no answer for `temperature`"));
  EXPECT_THAT(errors(study("  - dem.window: [0.2 s, 0.4 s]\n", "  setting: {dem.window: 0.4 s}\n", "", "dem")),
              HasSubstr("metrics[0]: the scene has no `temperature`: a DEM stage computes no temperatures"));
  EXPECT_THAT(errors(study(steps, first, "", "tracer", "[temperatur]")), HasSubstr("did you mean `temperature`?"));
}

TEST_F(StudyFile, TheStageMustSeeWhatIsVaried) {
  EXPECT_THAT(errors(study("  - dem.window: [0.2 s, 0.4 s]\n", "  setting: {dem.window: 0.4 s}\n")),
              HasSubstr("the DEM stage sees `dem.window`"));
  EXPECT_THAT(errors(study(steps, first, "", "dem", "[descent]")), HasSubstr("a DEM stage does not see"));
}

TEST_F(StudyFile, ReducedStandsInPlaceOfWhatItNames) {
  const std::string text = study(steps, first, "change: {tracer.duration: 1 h, launch.ranks: 1}\nseeds: 3\n");
  const std::string reduced =
      "reduced:\n  change: {tracer.duration: 300 s}\n  vary:\n    - tracer.time_step: [10 s, 20 s, 40 s]\n  seeds: 1\n";
  EXPECT_EQ(read(text + reduced).study.settings.size(), 2U) << "the full study does not see it";
  const ReadStudy small = read(text + reduced, StudySize::reduced);
  ASSERT_TRUE(small.ok()) << to_text(small.errors);
  EXPECT_EQ(small.study.settings.size(), 3U);
  EXPECT_EQ(small.study.seeds, 1);
  EXPECT_EQ(small.study.scene.tracer.duration, 300);
  EXPECT_EQ(small.study.scene.launch.ranks, 1) << "a key that only the full study changes stays changed";
  EXPECT_THAT(to_text(read(text, StudySize::reduced).errors), HasSubstr("has no section `reduced`"));
  const std::string wrong = text + "reduced:\n  vary:\n    - tracer.time_step: [10 s, -1 s]\n";
  EXPECT_THAT(to_text(read(wrong, StudySize::reduced).errors),
              HasSubstr(":13:32: vary[0].tracer.time_step[1]: must be"));
}

TEST_F(StudyFile, SettingsShareWhatDoesNotDependOnThem) {
  const ReadStudy read = this->read(study(steps, first, "seeds: 2\n"));
  ASSERT_TRUE(read.ok()) << to_text(read.errors);
  const StudyWork work = study_work(read.study, "/nowhere");
  EXPECT_EQ(work.tasks.size(), 5U) << "one DEM stage, a tracer stage for each step and seed";
  EXPECT_EQ(work.runs[3].shared, work.runs[0].shared);
  EXPECT_THAT(array_layers(work.tasks), ElementsAre(ElementsAre(0U), ElementsAre(1U, 2U, 3U, 4U)));
}

TEST(StudyArray, ListsItsMembersAsSlurmReadsThem) {
  EXPECT_EQ(array_list({0, 1, 2, 5, 7, 8}, 0), "0-2,5,7-8");
  EXPECT_EQ(array_list({4}, 3), "4%3");
}

TEST(ParetoFront, HoldsWhatNothingBeats) {
  const std::vector<CostAndError> points = {{10, 0.1}, {1, 1}, {100, 0.09}, {20, 0.5}, {1, 2}};
  EXPECT_THAT(pareto_front(points), ElementsAre(1U, 0U, 2U));
  // A factor of ten in time buys a factor of ten in error, the next one next to nothing.
  EXPECT_EQ(knee_of(points, pareto_front(points)), 0U);
  EXPECT_EQ(knee_of({{1, 1}, {10, 0.1}, {100, 0.01}}, {0, 1, 2}), std::nullopt) << "a straight front has no knee";
  EXPECT_EQ(knee_of({{1, 1}, {10, 0.1}}, {0, 1}), std::nullopt);
}

class PublishedData : public ::testing::Test {
 protected:
  DataTable read(const std::string& text) {
    std::ofstream(folder_.path() / "data.csv") << text;
    return read_data_table(folder_.path() / "data.csv", {"x", "value"});
  }
  std::string refusal(const std::string& text) {
    try {
      read(text);
    } catch (const Failure& failure) {
      return failure.what();
    }
    return "";
  }
  TemporaryFolder folder_;
};

TEST_F(PublishedData, IsReadByItsColumnsNames) {
  const DataTable table = read("# from the paper\nvalue, x\r\n1e3,-0.5\n2, 4\n");
  EXPECT_THAT(table.columns.at("x"), ElementsAre(-0.5, 4));
  EXPECT_THAT(table.columns.at("value"), ElementsAre(1000, 2));
}

TEST_F(PublishedData, WhatIsWrongIsNamed) {
  EXPECT_THAT(refusal("x,value\n1,2\n3,abc\n"), HasSubstr(":3: column value: `abc` is no number"));
  EXPECT_THAT(refusal("x,value\n1\n"), HasSubstr(":2: 1 values, but 2 columns"));
  EXPECT_THAT(refusal("x,height\n1,2\n"), HasSubstr("no column `value`"));
  EXPECT_THAT(refusal(""), HasSubstr("found none"));
}

/// A box of n x 1 x n cells of unit depth over [-1, 1] x [0, 2], full of solids.
StudyFields box(std::size_t n, const std::function<double(double, double)>& temperature) {
  StudyFields fields;
  fields.mesh_hash = std::to_string(n);
  const double size = 2.0 / static_cast<double>(n);
  const auto point = [&](std::size_t i, std::size_t j, std::size_t k) {
    return static_cast<std::int64_t>((k * 2 + j) * (n + 1) + i);
  };
  for (std::size_t k = 0; k <= n; ++k)
    for (std::size_t j = 0; j < 2; ++j)
      for (std::size_t i = 0; i <= n; ++i)
        for (const double x :
             {-1 + size * static_cast<double>(i), static_cast<double>(j), size * static_cast<double>(k)})
          fields.points.push_back(x);
  for (std::size_t k = 0; k < n; ++k)
    for (std::size_t i = 0; i < n; ++i) {
      for (const auto p : {point(i, 0, k), point(i + 1, 0, k), point(i + 1, 1, k), point(i, 1, k), point(i, 0, k + 1),
                           point(i + 1, 0, k + 1), point(i + 1, 1, k + 1), point(i, 1, k + 1)})
        fields.cell_points.push_back(p);
      const double x = -1 + size * (static_cast<double>(i) + 0.5), z = size * (static_cast<double>(k) + 0.5);
      fields.cell_volume.push_back(size * size);
      fields.solids_volume.push_back(0.6 * size * size);
      fields.temperature.push_back(temperature(x, z));
      fields.velocity.insert(fields.velocity.end(), {0, 0, -x});
    }
  return fields;
}

TEST(StudyErrors, OneMeshIsComparedCellByCell) {
  const StudyFields hot = box(4, [](double, double) { return 1293; });
  const StudyFields warm = box(4, [](double, double) { return 1393; });
  EXPECT_NEAR(metric_error(StudyMetric::temperature, warm, hot).value(), 0.1, 1e-12);
  EXPECT_NEAR(metric_error(StudyMetric::descent, warm, hot).value(), 0, 1e-12);
  EXPECT_FALSE(metric_error(StudyMetric::cohesive_zone, warm, hot).has_value());
}

TEST(StudyErrors, TwoMeshesAreComparedAsMeansOverBlocks) {
  // The same even field on any mesh; a slope differs by what a cell cannot show, less on finer meshes.
  const auto even = [](double, double) { return 800.; };
  EXPECT_NEAR(metric_error(StudyMetric::temperature, box(8, even), box(4, even)).value(), 0, 1e-12);
  const auto slope = [](double x, double z) { return 1293 + 300 * x + 200 * z; };
  const double coarse = metric_error(StudyMetric::temperature, box(4, slope), box(32, slope)).value();
  const double fine = metric_error(StudyMetric::temperature, box(16, slope), box(32, slope)).value();
  EXPECT_LT(coarse, 0.06);
  EXPECT_LT(fine, 0.5 * coarse);
}

TEST(StudyErrors, AgainstPublishedPointsAndNumbers) {
  StudyFields fields = box(8, [](double x, double) { return 1293 + 100 * x; });
  const DataTable data{{{"x", {-0.875, 0.875}}, {"z", {1.1, 1.1}}, {"value", {1293 - 87.5, 1293 + 87.5}}}};
  EXPECT_NEAR(metric_error(StudyMetric::temperature, fields, data).value(), 0, 1e-12);
  fields.pressure_drop = 1100;
  fields.top_gas_temperature = 400;
  EXPECT_NEAR(metric_error(StudyMetric::pressure_drop, fields, 1000.).value(), 0.1, 1e-12);
  EXPECT_NEAR(metric_error(StudyMetric::top_gas_temperature, fields, 390.).value(), 10, 1e-12);
}

TEST(StudyErrors, AColumnThatLosesItsZoneCountsAsMovedToTheLowest) {
  StudyFields one, other;
  one.zone_x = other.zone_x = {-1, 1};
  one.zone_area = other.zone_area = {1, 1};
  one.zone_height = {3, 2};
  other.zone_height = {3, NAN};
  EXPECT_NEAR(metric_error(StudyMetric::cohesive_zone, one, other).value(), 0, 1e-12);
  one.zone_height = {3, 4};
  EXPECT_NEAR(metric_error(StudyMetric::cohesive_zone, one, other).value(), std::sqrt(0.5), 1e-12);
}

TEST(TheNextHour, GoesWhereTheErrorFallsMost) {
  const ErrorSource noise{
      "the granular velocity's statistics", "a longer window", 0.2, 1200, ErrorSource::Law::statistics, 1};
  const ErrorSource step{"the tracers' time step", "a shorter step", 0.01, 60, ErrorSource::Law::first_order, 1};
  EXPECT_NEAR(noise.after(3600), 0.1, 1e-12) << "four times the window, half the error";
  EXPECT_NEAR(step.after(60), 0.005, 1e-12);
  const ErrorSource episodes{
      "the change from episode to episode", "more episodes", 0.5, 1800, ErrorSource::Law::contraction, 0.5};
  EXPECT_NEAR(episodes.after(3600), 0.125, 1e-12);
  ErrorSource noisy = episodes;
  noisy.floor = 0.2;
  EXPECT_NEAR(noisy.after(3600), 0.2, 1e-12) << "episodes repeat one another no better than their statistics";
  noisy.error = 0.1;
  EXPECT_NEAR(noisy.after(3600), 0.1, 1e-12);
  EXPECT_THAT(where_the_next_hour_helps({noise, step}),
              HasSubstr("help most in the granular velocity's statistics: 20 % now, about 10 % after it"));
  EXPECT_THAT(where_the_next_hour_helps({noise, step, episodes}),
              HasSubstr("most in the change from episode to episode"));
  EXPECT_EQ(where_the_next_hour_helps({}), "");
}

}  // namespace
}  // namespace cupola
