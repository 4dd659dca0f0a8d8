#include <gmock/gmock.h>

#include <cmath>

#include "orchestrator/report/report.hpp"
#include "orchestrator/run_folder.hpp"
#include "schemas/field_file.hpp"
#include "schemas/files.hpp"
#include "tests/support/temporary_folder.hpp"

namespace cupola {
namespace {

using nlohmann::json;
using testing::HasSubstr;

/// A run of cases/tiny as the orchestrator makes it, without any stage yet.
class MakeReport : public testing::Test {
 protected:
  [[nodiscard]] std::filesystem::path path() const { return folder.path() / "run"; }

  std::filesystem::path begin_stage(TaskKind kind, int episode = 1) const {
    const std::filesystem::path task = task_folder(path(), episode, kind, 1);
    std::filesystem::create_directories(task);
    return task;
  }

  /// A tracer result on two cells above each other, 0.4 m deep, whose stock line lies at 2.1 m, between them.
  void write_tracer_result(const std::filesystem::path& task) const {
    std::vector<double> points;
    for (const double z : {1.6, 2.1, 2.5}) {
      for (const auto& [x, y] : {std::pair{-0.3, -0.2}, {0.3, -0.2}, {0.3, 0.2}, {-0.3, 0.2}}) {
        points.insert(points.end(), {x, y, z});
      }
    }
    FieldFileWriter file(task / "result.hdf", {"tracer-result", run->campaign_hash(), "xxh3:mesh"}, points,
                         {0, 1, 2, 3, 4, 5, 6, 7, 4, 5, 6, 7, 8, 9, 10, 11});
    file.cell_data("solids_temperature", {1200, 300});
    file.cell_data("solids_fraction", {0.55, 0});
    file.cell_data("solids_velocity", {0, 3e-3, -4e-3, 0, 0, 0}, 3);
    file.hdf().write("CohesiveZone/x", std::vector<double>{0.1, -0.1, 0.1, -0.1});
    file.hdf().write("CohesiveZone/area", std::vector<double>{1, 1, 3, 1});
    file.hdf().write("CohesiveZone/height_melted", std::vector<double>{1.0, NAN, 2.0, NAN});
    file.hdf().write("CohesiveZone/height_softened", std::vector<double>{2.0, 2.0, 2.0, 2.2});
    file.summary({{"mean_solid_temperature", 1200.},
                  {"wall_seconds", 5.},
                  {"ledger", {{"mass", {{"residual", -1e-12}}}}},
                  {"clamps", {{"a", 2}, {"b", 3}}}});
    file.commit();
    append_history(task, {{"step", 1}, {"time", 10.}, {"mean_solid_temperature", 1190.}});
    append_history(task, {{"step", 2}, {"time", 20.}, {"mean_solid_temperature", nullptr}});
  }

  TemporaryFolder folder;
  std::unique_ptr<RunFolder> run = RunFolder::for_campaign(CUPOLA_SOURCE_DIR "/cases/tiny/campaign.yaml", path());
};

TEST_F(MakeReport, OfARunThatHasJustBegun) {
  const json report = make_report(path());
  EXPECT_EQ(report.at("state"), "not started");
  EXPECT_EQ(report.at("campaign"), "tiny");
  EXPECT_EQ(report.at("converged"), false);
  EXPECT_TRUE(report.at("episodes").empty());
  EXPECT_EQ(read_json(path() / "report/report.json"), report);
  EXPECT_THAT(read_text(path() / "report/index.html"), HasSubstr("\"campaign\":\"tiny\""));
}

TEST_F(MakeReport, TellsAFailedStage) {
  write_failure(begin_stage(TaskKind::dem), Failure(ExitCode::diverged, "parcel 7 left the domain"));
  const json report = make_report(path());
  EXPECT_EQ(report.at("state"), "failed");
  EXPECT_THAT(report.at("description"), HasSubstr("DEM stage of episode 1: parcel 7 left the domain"));
}

TEST_F(MakeReport, TellsADamagedResultInsteadOfReadingIt) {
  const std::filesystem::path task = begin_stage(TaskKind::dem);
  write_text_atomically(task / "result.hdf", "not an HDF5 file");
  write_manifest(task);
  const json report = make_report(path());
  EXPECT_EQ(report.at("episodes").at(0).at("dem").at("state"), "damaged");
  EXPECT_THAT(report.at("warnings").dump(), HasSubstr("result.hdf"));
}

TEST_F(MakeReport, ReadsFieldsZoneAndHistoryOfAResult) {
  begin_stage(TaskKind::dem);
  write_manifest(task_folder(path(), 1, TaskKind::dem, 1));
  const std::filesystem::path task = begin_stage(TaskKind::tracer);
  write_tracer_result(task);
  write_manifest(task);
  run->journal().append("episode-judged", {{"episode", 1},
                                           {"change", {{"granular_velocity", 0.5}}},
                                           {"figure", {{"granular_velocity", 1.}}},
                                           {"met", false}});
  run->journal().append("campaign-ended", {{"outcome", "converged"}, {"episodes", 1}, {"status", 0}});
  const json report = make_report(path());
  EXPECT_EQ(report.at("converged"), true);
  const json& episode = report.at("episodes").at(0);
  EXPECT_EQ(episode.at("mean_solid_temperature"), 1200.);
  EXPECT_EQ(episode.at("change").at("granular_velocity"), 0.5);
  EXPECT_TRUE(episode.at("change").at("temperature").is_null());
  EXPECT_EQ(report.at("ledger").at("mass_residual"), 1e-12);
  EXPECT_EQ(report.at("ledger").at("clamps"), 5.);
  EXPECT_EQ(report.at("wall_seconds"), 5.);
  const json& fields = report.at("charts").at("maps").at("episodes").at(0).at("fields");
  EXPECT_EQ(fields.at("solids_temperature"), json({1200., nullptr})) << "no solids above the stock line";
  EXPECT_EQ(fields.at("solids_speed"), json({5e-3, nullptr}));
  EXPECT_FALSE(fields.contains("gas_temperature"));
  const json& zone = report.at("charts").at("cohesive_zones").at(0);
  EXPECT_EQ(zone.at("x"), json({-0.1, 0.1}));
  EXPECT_EQ(zone.at("height_melted"), json({nullptr, 1.75})) << "weighted by area along the depth";
  EXPECT_EQ(zone.at("height_softened"), json({2.1, 2.}));
  EXPECT_EQ(report.at("charts").at("tracer_history").at(0).at("mean_solid_temperature"), json({1190., nullptr}));
}

}  // namespace
}  // namespace cupola
