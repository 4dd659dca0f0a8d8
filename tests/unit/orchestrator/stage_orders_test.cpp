#include "orchestrator/stage_orders.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>

#include "orchestrator/run_folder.hpp"
#include "schemas/field_file.hpp"
#include "tests/support/temporary_folder.hpp"

namespace cupola {
namespace {

using testing::Contains;
using testing::Key;
using testing::Not;

/// A run of two episodes whose predictions say whether they converged.
struct Episodes {
  explicit Episodes(bool converged, Strategy strategy = Strategy::predict_and_verify) {
    campaign.strategy = strategy;
    campaign.heat.emplace();
    campaign.predict_and_verify.windows = 5;
    for (int episode = 0; episode <= 2; ++episode) {
      const auto task = task_folder(folder.path(), episode, TaskKind::predict, 1);
      std::filesystem::create_directories(task);
      FieldFileWriter file(task / "result.hdf", {"tracer-result", "", ""},
                           {0, 0, 0, 1, 0, 0, 1, 1, 0, 0, 1, 0, 0, 0, 1, 1, 0, 1, 1, 1, 1, 0, 1, 1},
                           {0, 1, 2, 3, 4, 5, 6, 7});
      file.summary({{"layer_passage", 600.}, {"prediction", {{"converged", converged}}}});
      file.commit();
    }
    std::ofstream(task_folder(folder.path(), 0, TaskKind::predict, 1) / "manifest.json") << "{}";
  }

  [[nodiscard]] std::filesystem::path task(int episode, TaskKind kind) const {
    return task_folder(folder.path(), episode, kind, 1);
  }
  [[nodiscard]] EpisodeFolders episode(int number, bool corrected) const {
    EpisodeFolders folders{task(number, TaskKind::dem), task(number, TaskKind::tracer), task(number, TaskKind::predict),
                           std::nullopt};
    if (corrected) folders.correct = task(number, TaskKind::correct);
    return folders;
  }
  [[nodiscard]] std::optional<StageOrder> order(TaskKind kind, const std::vector<EpisodeFolders>& before,
                                                const EpisodeFolders& now) const {
    return stage_order(kind, before, now, folder.path(), campaign);
  }

  TemporaryFolder folder;
  Campaign campaign;
};

TEST(StageOrders, AnEpisodeGoesOnFromTheCorrectedPredictionOfTheOneBefore) {
  const Episodes run(true);
  const auto before = std::vector{run.episode(1, true)};
  const auto now = run.episode(2, false);
  const auto corrected = run.task(1, TaskKind::correct) / "result.hdf";
  const auto dem = run.order(TaskKind::dem, before, {});
  EXPECT_EQ(dem->inputs.at("solids_temperature"), corrected);
  EXPECT_EQ(dem->inputs.at("packing"), run.task(1, TaskKind::dem) / "result.hdf");
  const auto predict = run.order(TaskKind::predict, before, now);
  EXPECT_EQ(predict->inputs.at("granular"), run.task(2, TaskKind::dem) / "result.hdf");
  EXPECT_EQ(predict->inputs.at("solids_temperature"), corrected);
  EXPECT_EQ(predict->inputs.at("correction"), corrected);
  const auto tracer = run.order(TaskKind::tracer, before, now);
  EXPECT_EQ(tracer->inputs.at("solids_temperature"), corrected) << "what its DEM stage softened by";
  EXPECT_EQ(tracer->inputs.at("prediction"), run.task(2, TaskKind::predict) / "result.hdf");
  EXPECT_DOUBLE_EQ(tracer->tracer_duration.value(), 5 * 600.);
  const auto correct = run.order(TaskKind::correct, before, now);
  EXPECT_EQ(correct->inputs.at("march"), run.task(2, TaskKind::tracer) / "result.hdf");
}

TEST(StageOrders, TheFirstEpisodeGoesByTheFirstPrediction) {
  const Episodes run(true);
  const auto dem = run.order(TaskKind::dem, {}, {});
  EXPECT_EQ(dem->inputs.at("solids_temperature"), run.folder.path() / "prediction" / "result.hdf");
  EXPECT_THAT(dem->inputs, Not(Contains(Key("packing"))));
  EXPECT_THAT(run.order(TaskKind::predict, {}, run.episode(1, false))->inputs, Not(Contains(Key("correction"))));
}

TEST(StageOrders, WithoutPredictionsTheCampaignMarches) {
  const Episodes run(false);
  EXPECT_THAT(run.order(TaskKind::dem, {}, {})->inputs, Not(Contains(Key("solids_temperature"))));
  const auto tracer = run.order(TaskKind::tracer, {}, run.episode(1, false));
  EXPECT_THAT(tracer->inputs, Not(Contains(Key("prediction"))));
  EXPECT_FALSE(tracer->tracer_duration);
  EXPECT_FALSE(run.order(TaskKind::correct, {}, run.episode(1, false)));
  const auto next = run.order(TaskKind::dem, {run.episode(1, false)}, {});
  EXPECT_EQ(next->inputs.at("solids_temperature"), run.task(1, TaskKind::tracer) / "result.hdf");
}

TEST(StageOrders, MarchingGoesByTheTracerStageBefore) {
  const Episodes run(true, Strategy::march);
  const std::vector<EpisodeFolders> before{{run.task(1, TaskKind::dem), run.task(1, TaskKind::tracer), {}, {}}};
  const auto tracer = run.order(TaskKind::tracer, before, {run.task(2, TaskKind::dem), {}, {}, {}});
  EXPECT_EQ(tracer->inputs.size(), 2U);
  EXPECT_EQ(tracer->inputs.at("granular"), run.task(2, TaskKind::dem) / "result.hdf");
  EXPECT_EQ(tracer->inputs.at("solids_temperature"), run.task(1, TaskKind::tracer) / "result.hdf");
}

}  // namespace
}  // namespace cupola
