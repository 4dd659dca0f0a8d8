#include "orchestrator/remaining_time.hpp"

#include <gtest/gtest.h>

namespace cupola {
namespace {

using nlohmann::json;

json judged(double temperature, const json& lambda, double velocity, bool met = false) {
  return {{"change", {{"temperature", temperature}, {"granular_velocity", velocity}}},
          {"lambda", {{"temperature", lambda}}},
          {"met", met}};
}

Converged two_on_end() {
  Converged converged;
  converged.for_episodes = 2;
  return converged;
}

TEST(RemainingEpisodes, FollowTheContraction) {
  // 8 over the criterion, halved an episode: met after three more; the second on end is the fourth.
  const auto left = remaining_episodes({judged(16, nullptr, 0.5), judged(8, 0.5, 0.5)}, two_on_end(), 20);
  ASSERT_TRUE(left);
  EXPECT_EQ(left->episodes, 4);
  EXPECT_FALSE(left->until_limit);
  EXPECT_EQ(left->why, "temperature takes longest");
}

TEST(RemainingEpisodes, UseTheLastTwoChangesWhereARuleHasNoLambda) {
  const auto left = remaining_episodes({judged(0.5, 0.5, 4), judged(0.5, 0.5, 2)}, two_on_end(), 20);
  ASSERT_TRUE(left);
  EXPECT_EQ(left->episodes, 2);  // met after one more, and one on end
  EXPECT_EQ(left->why, "granular_velocity takes longest");
}

TEST(RemainingEpisodes, GoToTheLimitWhereNothingContracts) {
  const auto left = remaining_episodes({judged(3, nullptr, 0.5), judged(3, 1.2, 0.5)}, two_on_end(), 8);
  ASSERT_TRUE(left);
  EXPECT_TRUE(left->until_limit);
  EXPECT_EQ(left->episodes, 6);
  const auto slow = remaining_episodes({judged(300, nullptr, 0.5), judged(200, 0.9, 0.5)}, two_on_end(), 8);
  EXPECT_TRUE(slow->until_limit);
  EXPECT_EQ(slow->episodes, 6);
}

TEST(RemainingEpisodes, CountWhatHasBeenMetOnEnd) {
  const auto left =
      remaining_episodes({judged(9, 0.5, 0.5), judged(2, 0.3, 0.5), judged(0.5, 0.3, 0.5, true)}, two_on_end(), 8);
  ASSERT_TRUE(left);
  EXPECT_EQ(left->episodes, 1);
  EXPECT_EQ(left->why, "all rules are met");
}

TEST(RemainingEpisodes, AreNotKnownAtFirst) {
  EXPECT_FALSE(remaining_episodes({judged(1, nullptr, 1)}, two_on_end(), 8));
}

}  // namespace
}  // namespace cupola
