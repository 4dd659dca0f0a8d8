#include <gtest/gtest.h>

#include <cmath>

#include "schemas/campaign_reader.hpp"
#include "tests/support/tracer_program.hpp"

/// When the march ends, and what its steps cost in accuracy.
namespace cupola {
namespace {

using TracerTask = testing::TracerProgram;

Campaign tiny() {
  Campaign campaign = load_campaign(std::filesystem::path(CUPOLA_SOURCE_DIR) / "cases" / "tiny" / "campaign.yaml");
  campaign.tracer.duration = 600;
  return campaign;
}

/// rms(T - T_ref)/rms(T_ref - 293 K) of the solids temperature over the cells that do not stand still.
double distance(const FieldFile& field, const FieldFile& reference) {
  const auto a = field.cell_data("solids_temperature");
  const auto b = reference.cell_data("solids_temperature");
  const auto stagnant = reference.cell_data("stagnant");
  double square = 0;
  double norm = 0;
  for (std::size_t c = 0; c < a.size(); ++c) {
    if (stagnant[c] > 0) continue;
    square += (a[c] - b[c]) * (a[c] - b[c]);
    norm += (b[c] - 293) * (b[c] - 293);
  }
  return std::sqrt(square / norm);
}

TEST(TracerStageControl, EndsWhenSteadyAndMarchingOnAgrees) {
  Campaign campaign = tiny();
  campaign.tracer.stop = TracerSettings::Stop::steady;
  campaign.tracer.at_most = 20000;
  campaign.tracer.remaining_change = 0.03;
  const TracerTask task(campaign);
  ASSERT_EQ(task.run(), 0);
  const nlohmann::json summary = task.result().summary();
  ASSERT_TRUE(summary["steady"]["reached"].get<bool>());
  const double ended = summary["process_seconds"];
  EXPECT_LT(ended, 15000);
  EXPECT_LE(summary["steady"]["remaining_change"].get<double>(), 0.03);

  Campaign longer = tiny();
  longer.tracer.duration = 2 * ended;
  const TracerTask on(longer);
  ASSERT_EQ(on.run(), 0);
  const double change = distance(task.result(), on.result());
  EXPECT_LT(change, 0.03);
  RecordProperty("ended_at", std::to_string(ended));
  RecordProperty("true_change", std::to_string(change));
  RecordProperty("estimate", std::to_string(summary["steady"]["remaining_change"].get<double>()));
}

TEST(TracerStageControl, TheEstimateIsNotBelowTheTruth) {
  Campaign fine = tiny();
  fine.tracer.time_step = 0.5;
  const TracerTask reference(fine);
  ASSERT_EQ(reference.run(), 0);
  for (const double seconds : {4.0, 12.0}) {
    Campaign campaign = tiny();
    campaign.tracer.time_step = seconds;
    const TracerTask task(campaign);
    ASSERT_EQ(task.run(), 0);
    const double error = distance(task.result(), reference.result());
    const double estimate = task.result().summary()["accuracy"]["time_step_error"];
    EXPECT_GT(error, 0) << seconds;
    EXPECT_LE(error, estimate) << seconds;
    RecordProperty("error_" + std::to_string(seconds), std::to_string(error));
    RecordProperty("estimate_" + std::to_string(seconds), std::to_string(estimate));
  }
}

TEST(TracerStageControl, RingsAndBothDisplacementsKeepTheBalances) {
  Campaign campaign = tiny();
  campaign.charging.layers = {{{"coke", 22.0}}, {{"ore", 50.0}}, {{"coke", 4.0}}};
  campaign.charging.rings = {std::nullopt, std::nullopt, std::array<double, 2>{0.15, 0.32}};
  campaign.tracer.displacement = TracerSettings::Displacement::random_and_relaxation;
  const TracerTask task(campaign);
  ASSERT_EQ(task.run(), 0);
  const nlohmann::json summary = task.result().summary();
  EXPECT_LT(summary["ledger"]["mass"]["residual"].get<double>(), 1e-12);
  EXPECT_LT(summary["ledger"]["energy"]["residual"].get<double>(), 1e-6);
  EXPECT_EQ(summary["ledger"]["mass"]["out"]["lost"].get<double>(), 0);
  EXPECT_TRUE(summary.contains("displacements_held_back"));
}

}  // namespace
}  // namespace cupola
