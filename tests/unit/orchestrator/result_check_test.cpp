#include "orchestrator/result_check.hpp"

#include <gmock/gmock.h>

#include <cmath>
#include <fstream>
#include <functional>

#include "orchestrator/episode_judgement.hpp"
#include "orchestrator/prediction_judgement.hpp"
#include "schemas/campaign_reader.hpp"
#include "schemas/field_file.hpp"
#include "schemas/files.hpp"
#include "tests/support/temporary_folder.hpp"

namespace {

using cupola::Campaign;
using cupola::ExitCode;
using cupola::Failure;
using cupola::FieldFileWriter;
using cupola::TaskKind;
using cupola::TemporaryFolder;
using nlohmann::json;
using ::testing::HasSubstr;

const std::string campaign_hash = "xxh3:c0ffee";

Campaign tiny() { return cupola::load_campaign(std::filesystem::path(CUPOLA_SOURCE_DIR) / "cases/tiny/campaign.yaml"); }

/// Two unit cells, one on the other.
FieldFileWriter two_cells(const std::filesystem::path& file, const std::string& kind) {
  std::vector<double> points;
  for (const double z : {0., 1., 2.})
    for (const auto& [x, y] : {std::pair{0., 0.}, {1., 0.}, {1., 1.}, {0., 1.}}) points.insert(points.end(), {x, y, z});
  return FieldFileWriter(file, {kind, campaign_hash, "xxh3:mesh"}, points,
                         {0, 1, 2, 3, 4, 5, 6, 7, 4, 5, 6, 7, 8, 9, 10, 11});
}

struct Episode {
  double temperature = 1000, height = 1.5, velocity = -2e-3, error = 0.1;
  double energy_residual = 1e-3, mass_residual = 1e-12, unmelted = 0;
};

/// The results of an episode as the stages lay them out, with chosen numbers.
cupola::EpisodeFolders write_episode(const std::filesystem::path& folder, const Episode& episode) {
  const cupola::EpisodeFolders folders{folder / "dem", folder / "tracer"};
  std::filesystem::create_directories(folders.dem);
  std::filesystem::create_directories(folders.tracer / "foam");
  FieldFileWriter dem = two_cells(folders.dem / "result.hdf", "dem-result");
  dem.cell_data("solids_fraction", {0.55, 0.6});
  dem.cell_data("solids_velocity_error", std::vector<double>(6, episode.error), 3);
  dem.summary({{"parcels", 10}, {"ledger", {{"residual", episode.mass_residual}}}});
  dem.commit();
  cupola::HdfWriter mesh(folders.tracer / "foam/mesh.hdf");
  mesh.write("Mesh/cell_volume", std::vector<double>{1, 1});
  mesh.commit();
  FieldFileWriter tracer = two_cells(folders.tracer / "result.hdf", "tracer-result");
  tracer.cell_data("solids_fraction", {0.55, 0.6});
  tracer.cell_data("stagnant", {1, 0});
  tracer.cell_data("solids_velocity", {0, 0, 9 * episode.velocity, 0, 0, episode.velocity}, 3);
  tracer.cell_data("volume_share.coke", {0.5, 0.5});
  tracer.cell_data("volume_share.ore", {0.5, 0.5});
  for (const char* mean : {"solids_temperature", "solids_temperature.coke", "solids_temperature.ore"})
    tracer.cell_data(mean, {2 * episode.temperature, episode.temperature});
  tracer.hdf().write("CohesiveZone/height_melted", std::vector<double>{episode.height, episode.height});
  tracer.hdf().write("CohesiveZone/area", std::vector<double>{1, 1});
  tracer.summary(
      {{"scale", 0.01},
       {"cohesive_zone", {{"height_mean", nullptr}}},
       {"ledger",
        {{"mass", {{"in", 100}, {"out", {{"unmelted", episode.unmelted}}}, {"residual", episode.mass_residual}}},
         {"energy", {{"residual", episode.energy_residual}}}}}});
  tracer.commit();
  cupola::write_manifest(folders.dem);
  cupola::write_manifest(folders.tracer);
  return folders;
}

Failure refusal(const std::filesystem::path& folder, TaskKind kind, const std::string& hash = campaign_hash) {
  try {
    cupola::check_result(folder, kind, tiny(), hash);
  } catch (const Failure& failure) {
    return failure;
  }
  ADD_FAILURE() << "accepted";
  return {ExitCode::done, ""};
}

TEST(ResultCheck, AcceptsWhatIsSound) {
  const TemporaryFolder folder;
  const auto episode = write_episode(folder.path(), {});
  EXPECT_NO_THROW(cupola::check_result(episode.dem, TaskKind::dem, tiny(), campaign_hash));
  EXPECT_NO_THROW(cupola::check_result(episode.tracer, TaskKind::tracer, tiny(), campaign_hash));
}

TEST(ResultCheck, RefusesOpenLedgers) {
  const TemporaryFolder folder;
  auto episode = write_episode(folder.path() / "1", {.mass_residual = 1e-6});
  EXPECT_EQ(refusal(episode.dem, TaskKind::dem).code(), ExitCode::diverged);
  EXPECT_THAT(refusal(episode.tracer, TaskKind::tracer).what(), HasSubstr("/ledger/mass/residual"));
  episode = write_episode(folder.path() / "2", {.energy_residual = 0.006});
  EXPECT_THAT(refusal(episode.tracer, TaskKind::tracer).what(), HasSubstr("/ledger/energy/residual is 0.006"));
  episode = write_episode(folder.path() / "3", {.energy_residual = std::nan("")});
  EXPECT_THAT(refusal(episode.tracer, TaskKind::tracer).what(), HasSubstr("not a finite number"));
}

TEST(ResultCheck, RefusesFieldsOutOfBounds) {
  const TemporaryFolder folder;
  auto episode = write_episode(folder.path() / "1", {.temperature = std::nan("")});
  EXPECT_THAT(refusal(episode.tracer, TaskKind::tracer).what(), HasSubstr("solids_temperature in cell 0"));
  episode = write_episode(folder.path() / "2", {.temperature = -5});
  EXPECT_EQ(refusal(episode.tracer, TaskKind::tracer).code(), ExitCode::diverged);
}

TEST(ResultCheck, RefusesDamageAndForeignFiles) {
  const TemporaryFolder folder;
  const auto episode = write_episode(folder.path(), {});
  EXPECT_EQ(refusal(episode.dem, TaskKind::dem, "xxh3:other").code(), ExitCode::wrong_input);
  EXPECT_EQ(refusal(episode.dem, TaskKind::tracer).code(), ExitCode::wrong_input);
  const auto result = episode.dem / "result.hdf";
  std::filesystem::resize_file(result, std::filesystem::file_size(result) / 2);
  EXPECT_EQ(refusal(episode.dem, TaskKind::dem).code(), ExitCode::input_output);
  // The manifest may be made anew around a truncated file; the file itself still cannot be read.
  cupola::write_manifest(episode.dem);
  EXPECT_EQ(refusal(episode.dem, TaskKind::dem).code(), ExitCode::input_output);
}

TEST(EpisodeJudgement, FollowsTheSequenceAndLeavesStagnantCellsOut) {
  const TemporaryFolder folder;
  const Campaign campaign = tiny();
  std::vector<cupola::EpisodeFolders> episodes;
  // 1000, 900, 850 K: lambda 0.5, 50 K to come, over 557 K; the zone 1.5, 1.3, 1.2 m.
  episodes.push_back(write_episode(folder.path() / "1", {}));
  json judged = cupola::judge_episode(episodes, campaign);
  EXPECT_TRUE(judged["change"]["temperature"].is_null());
  EXPECT_FALSE(judged["met"].get<bool>());
  episodes.push_back(write_episode(folder.path() / "2", {.temperature = 900, .height = 1.3}));
  judged = cupola::judge_episode(episodes, campaign);
  EXPECT_NEAR(judged["figure"]["temperature"], 100. / 607, 1e-12);
  EXPECT_TRUE(judged["lambda"]["temperature"].is_null());
  episodes.push_back(
      write_episode(folder.path() / "3", {.temperature = 850, .height = 1.2, .velocity = -3e-3, .unmelted = 6}));
  judged = cupola::judge_episode(episodes, campaign);
  EXPECT_NEAR(judged["lambda"]["temperature"], 0.5, 1e-12);
  EXPECT_NEAR(judged["figure"]["temperature"], 50. / 557, 1e-12);
  EXPECT_NEAR(judged["figure"]["cohesive_zone"], 0.1 / campaign.scene.mesh.cell, 1e-12);
  EXPECT_NEAR(judged["unmelted_share"], 0.06, 1e-12);
  // 1 mm/s in one of three components; error 0.1 m/s at DEM speed, 1 mm/s at descent, in each episode and component.
  EXPECT_NEAR(judged["figure"]["granular_velocity"], std::sqrt(1. / 3 / 2), 1e-9);
  EXPECT_FALSE(judged["met"].get<bool>());
}

/// A corrected prediction with chosen numbers.
void write_correction(const std::filesystem::path& task, double temperature, double height, double to_go,
                      double from_prediction) {
  std::filesystem::create_directories(task);
  FieldFileWriter file = two_cells(task / "result.hdf", "tracer-result");
  file.cell_data("solids_temperature", {2 * temperature, temperature});
  file.hdf().write("CohesiveZone/height_melted", std::vector<double>{height, height});
  file.hdf().write("CohesiveZone/area", std::vector<double>{1, 1});
  file.summary({{"correction", {{"to_go", to_go}, {"noise", 0.003}, {"from_prediction", from_prediction}}}});
  file.commit();
}

TEST(PredictionJudgement, EstimatesTheErrorFromAllThatWasMeasured) {
  const TemporaryFolder folder;
  const Campaign campaign = tiny();  // 1 % and one cell, by default
  std::vector<cupola::EpisodeFolders> episodes{write_episode(folder.path() / "1", {})};
  episodes.back().correct = folder.path() / "1" / "correct";
  write_correction(*episodes.back().correct, 1000, 1.5, 0.004, 0.005);
  json judged = cupola::judge_prediction(episodes, "", campaign);
  EXPECT_TRUE(judged["change"]["temperature"].is_null()) << "nothing to compare with";
  EXPECT_FALSE(judged["met"].get<bool>());
  EXPECT_TRUE(cupola::is_verified(judged));

  episodes.push_back(write_episode(folder.path() / "2", {}));
  episodes.back().correct = folder.path() / "2" / "correct";
  write_correction(*episodes.back().correct, 1002, 1.52, 0.004, 0.005);
  const auto before = *episodes.front().correct / "result.hdf";
  judged = cupola::judge_prediction(episodes, before, campaign);
  const double jump = 2. / (1002 - 293);
  EXPECT_NEAR(judged["remaining_error"]["jump"], jump, 1e-12) << "the stagnant cell does not count";
  EXPECT_NEAR(judged["figure"]["temperature"], 1.5 * std::sqrt(jump * jump + 0.004 * 0.004 + 0.003 * 0.003), 1e-12);
  EXPECT_NEAR(judged["figure"]["left_alone"], 0.004, 1e-12) << "beyond the noise";
  EXPECT_NEAR(judged["figure"]["cohesive_zone"], 1.5 * 0.02 / campaign.scene.mesh.cell, 1e-12);
  EXPECT_TRUE(judged["met"].get<bool>());

  // Tracers that leave their prediction refute it, however little the last step changed.
  write_correction(*episodes.back().correct, 1002, 1.52, 0.004, 0.02);
  EXPECT_FALSE(cupola::judge_prediction(episodes, before, campaign)["met"].get<bool>());
  write_correction(*episodes.back().correct, 1002, 1.52, 0.01, 0.005);
  EXPECT_FALSE(cupola::judge_prediction(episodes, before, campaign)["met"].get<bool>()) << "still on its way";
}

}  // namespace
