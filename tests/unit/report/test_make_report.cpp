#include <gmock/gmock.h>

#include <cmath>

#include "orchestrator/report/report.hpp"
#include "orchestrator/run_check.hpp"
#include "orchestrator/run_folder.hpp"
#include "schemas/field_file.hpp"
#include "schemas/files.hpp"
#include "schemas/version.hpp"
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
  EXPECT_EQ(read_sealed_json(path() / "report/report.json"), report);
  EXPECT_THAT(read_text(path() / "report/index.html"), HasSubstr("\"campaign\":\"tiny\""));
}

TEST(MakeReportOf, ASceneWithAnEmptySpeciesTellsIt) {
  const TemporaryFolder folder;
  std::string text = read_text(CUPOLA_SOURCE_DIR "/cases/tiny/campaign.yaml");
  const std::string charged = ", {ore: 60 kg}";
  ASSERT_NE(text.find(charged), std::string::npos);
  text.erase(text.find(charged), charged.size());
  write_text_atomically(folder.path() / "campaign.yaml", text);
  const auto run = RunFolder::for_campaign(folder.path() / "campaign.yaml", folder.path() / "run");
  EXPECT_THAT(make_report(folder.path() / "run").at("warnings").dump(),
              HasSubstr("No layer of charging.layers holds ore"));
}

TEST_F(MakeReport, TellsAFailedStage) {
  write_failure(begin_stage(TaskKind::dem), Failure(ExitCode::diverged, "parcel 7 left the domain")
                                                .at("step", "5205")
                                                .advise("dem.rayleigh_fraction", "0.0124")
                                                .advise("contacts.youngs_modulus", "1e+07 Pa"));
  const json report = make_report(path());
  EXPECT_EQ(report.at("state"), "failed");
  const std::string told =
      "parcel 7 left the domain (step 5205). Try contacts.youngs_modulus: 1e+07 Pa or dem.rayleigh_fraction: 0.0124.";
  EXPECT_EQ(report.at("description"), "DEM stage of episode 1: " + told);
  EXPECT_THAT(report.at("warnings").dump(), HasSubstr(told));
  EXPECT_EQ(report.at("results").at(0).at("sentence"), told);
}

TEST_F(MakeReport, SaysHowToComputeItAgain) {
  const auto command = [&] { return make_report(path()).at("provenance").at("command").get<std::string>(); };
  EXPECT_EQ(command(), "cupola run campaign.yaml --run-dir NEW_FOLDER") << "as the campaign has it";
  const int ranks = run->campaign().launch.ranks + 1;
  run->journal().append("orchestrator-started", {{"at_most", 1}});
  run->journal().append("ranks-changed", {{"ranks", ranks}});
  const std::string again =
      "cupola run campaign.yaml --run-dir NEW_FOLDER --at-most 1 --ranks " + std::to_string(ranks);
  EXPECT_EQ(command(), again);
  run->journal().append("stage-prepared", {{"stage", "dem"}, {"episode", 1}, {"attempt", 1}, {"ranks", ranks}});
  EXPECT_EQ(command(), again);
  run->journal().append("stage-prepared", {{"stage", "tracer"}, {"episode", 1}, {"attempt", 1}, {"ranks", 7}});
  const json from = make_report(path()).at("provenance");
  EXPECT_EQ(from.at("command"), again) << "the ranks it began with";
  EXPECT_THAT(from.at("ranks_changed"), HasSubstr("7 from the tracer stage"));
}

TEST_F(MakeReport, AFlippedByteOfItsNumbersIsFound) {
  make_report(path());
  EXPECT_TRUE(check_run(path()).problems.empty());
  const std::filesystem::path file = path() / "report/report.json";
  const std::string text = read_text(file);
  for (const std::size_t place : {std::size_t{0}, text.size() / 2, text.size() - 1}) {
    std::string flipped = text;
    flipped[place] = static_cast<char>(flipped[place] ^ 1);
    write_text_atomically(file, flipped);
    EXPECT_THAT(check_run(path()).problems, testing::ElementsAre(HasSubstr("report.json"))) << "byte " << place;
  }
  make_report(path());
  EXPECT_TRUE(check_run(path()).problems.empty());
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

TEST_F(MakeReport, SaysWhereTheNumbersComeFrom) {
  const std::filesystem::path task = begin_stage(TaskKind::tracer);
  write_tracer_result(task);
  write_manifest(task);
  begin_stage(TaskKind::dem);
  write_text_atomically(task_folder(path(), 1, TaskKind::dem, 1) / "task.yaml",
                        "random_seed: 17\nprogram_version: 0.1.0\ninputs:\n  packing: {file: "
                        "../../../000/dem/attempt-1/result.hdf, hash: xxh3:before}\n");
  write_manifest(task_folder(path(), 1, TaskKind::dem, 1));
  const json report = make_report(path());
  const json& from = report.at("provenance");
  EXPECT_EQ(from.at("campaign_hash"), hash_file(path() / "campaign.yaml"));
  EXPECT_EQ(from.at("resolved_hash"), hash_file(path() / "resolved.yaml"));
  EXPECT_EQ(from.at("stages").at(0).at("random_seed"), "17");
  EXPECT_EQ(from.at("stages").at(0).at("inputs").at("packing").at("file"), "episodes/000/dem/attempt-1/result.hdf");
  EXPECT_EQ(from.at("stages").at(0).at("inputs").at("packing").at("hash"), "xxh3:before");
  const json& file = from.at("stages").at(1).at("files").at("episodes/001/tracer/attempt-1/result.hdf");
  EXPECT_EQ(file.at("hash"), hash_file(task / "result.hdf"));
  EXPECT_EQ(file.at("size"), std::filesystem::file_size(task / "result.hdf"));
  for (const char* library : {"cupola", "OpenFOAM", "LIGGGHTS", "Open MPI", "HDF5", "compiler"})
    EXPECT_TRUE(report.at("versions").contains(library)) << library;
}

TEST_F(MakeReport, IsAResearchObjectCrate) {
  const std::filesystem::path task = begin_stage(TaskKind::tracer);
  write_tracer_result(task);
  write_manifest(task);
  begin_stage(TaskKind::dem);
  make_report(path());
  const json crate = read_json(path() / "ro-crate-metadata.json");
  EXPECT_EQ(crate.at("@context"), "https://w3id.org/ro/crate/1.1/context");
  std::map<std::string, json> entities;
  for (const json& entity : crate.at("@graph")) {
    EXPECT_TRUE(entities.emplace(entity.at("@id").get<std::string>(), entity).second) << entity.at("@id");
    EXPECT_TRUE(entity.contains("@type"));
  }
  EXPECT_EQ(entities.at("ro-crate-metadata.json").at("about").at("@id"), "./");
  // Every part is described, and every file that is described is there.
  for (const json& part : entities.at("./").at("hasPart")) {
    const std::string file = part.at("@id");
    ASSERT_TRUE(entities.contains(file)) << file;
    EXPECT_TRUE(std::filesystem::exists(path() / file)) << file;
  }
  const json& result = entities.at("episodes/001/tracer/attempt-1/result.hdf");
  EXPECT_EQ(result.at("identifier"), hash_file(task / "result.hdf"));
  for (const char* file : {"run.json", "report/report.json", "report/index.html", "fields/tracer_fields.xdmf"}) {
    EXPECT_EQ(entities.at(file).at("identifier"), hash_file(path() / file)) << file;
    EXPECT_EQ(entities.at(file).at("contentSize"), std::to_string(std::filesystem::file_size(path() / file))) << file;
  }
  // Whose data it is, and under which licence, is for its owner to say; what was said is kept.
  EXPECT_FALSE(entities.at("./").contains("license"));
  json licensed = crate;
  for (json& entity : licensed.at("@graph"))
    if (entity.at("@id") == "./") {
      entity["license"] = "https://creativecommons.org/licenses/by/4.0/";
      entity["author"] = {{"@id", "#engineer"}};
    }
  licensed.at("@graph").push_back({{"@id", "#engineer"}, {"@type", "Person"}, {"name", "Anna Engineer"}});
  write_json_atomically(path() / "ro-crate-metadata.json", licensed);
  make_report(path());
  const json kept = read_json(path() / "ro-crate-metadata.json");
  for (const json& entity : kept.at("@graph")) {
    if (entity.at("@id") != "./") continue;
    EXPECT_EQ(entity.at("license"), "https://creativecommons.org/licenses/by/4.0/");
    EXPECT_EQ(entity.at("author").at("@id"), "#engineer");
  }
  EXPECT_THAT(kept.dump(), HasSubstr("Anna Engineer"));
  EXPECT_EQ(entities.at("#campaign").at("instrument").at("@id"), "#cupola-" + std::string(program_version));
}

TEST_F(MakeReport, LeavesViewsForParaViewThatNameTheResults) {
  const std::filesystem::path task = begin_stage(TaskKind::tracer);
  write_tracer_result(task);
  write_manifest(task);
  begin_stage(TaskKind::dem);
  make_report(path());
  const std::string view = read_text(path() / "fields/tracer_fields.xdmf");
  EXPECT_THAT(view, HasSubstr("<Time Value=\"1\"/>"));
  EXPECT_THAT(view, HasSubstr("<DataItem Dimensions=\"2 8\" NumberType=\"Int\" Precision=\"8\" Format=\"HDF\">"
                              "../episodes/001/tracer/attempt-1/result.hdf:/VTKHDF/Connectivity</DataItem>"));
  EXPECT_THAT(view, HasSubstr("Name=\"solids_velocity\" AttributeType=\"Vector\" Center=\"Cell\""));
  EXPECT_FALSE(std::filesystem::exists(path() / "fields/tracers.xdmf"));  // the result has none
}

}  // namespace
}  // namespace cupola
