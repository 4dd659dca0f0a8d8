#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>

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

/// Error of a march against one of short steps, and what it says of itself.
struct Judged {
  double error = 0, estimate = 0, step = 0;
};

class StepControl : public ::testing::Test {
 protected:
  static void SetUpTestSuite() {
    Campaign fine = tiny();
    fine.tracer.time_step = 0.5;
    fine.tracer.resolve = TracerSettings::Resolve::every_step;
    reference_ = new TracerTask(fine);
    ASSERT_EQ(reference_->run(), 0);
  }
  static void TearDownTestSuite() {
    delete reference_;
    reference_ = nullptr;
  }
  static Judged judge(const Campaign& campaign) {
    const TracerTask task(campaign);
    EXPECT_EQ(task.run(), 0);
    const nlohmann::json summary = task.result().summary();
    Judged judged{distance(task.result(), reference_->result()), summary["accuracy"]["time_step_error"],
                  summary["time_step"]};
    std::printf("step %.3g s: error %.3g, estimate %.3g\n", judged.step, judged.error, judged.estimate);
    return judged;
  }
  static TracerTask* reference_;
};
TracerTask* StepControl::reference_ = nullptr;

TEST_F(StepControl, TheEstimateIsNotBelowTheTruthNorFarAbove) {
  for (const double seconds : {4.0, 12.0}) {
    Campaign campaign = tiny();
    campaign.tracer.time_step = seconds;
    campaign.tracer.resolve = TracerSettings::Resolve::every_step;  // the flow's lag is no error of the step
    const Judged judged = judge(campaign);
    EXPECT_NEAR(judged.step, seconds, 1e-9);
    EXPECT_GT(judged.error, 0);
    EXPECT_LE(judged.error, judged.estimate);
    EXPECT_LE(judged.estimate, 8 * judged.error);
  }
}

TEST_F(StepControl, TheStepFollowsTheAccuracyAskedFor) {
  std::vector<double> steps;
  for (const double accuracy : {0.01, 0.05}) {
    Campaign campaign = tiny();
    campaign.tracer.accuracy = accuracy;
    const Judged judged = judge(campaign);
    EXPECT_LE(judged.error, accuracy);
    EXPECT_LE(judged.error, judged.estimate);
    steps.push_back(judged.step);
  }
  EXPECT_LT(steps[0], steps[1]);
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
