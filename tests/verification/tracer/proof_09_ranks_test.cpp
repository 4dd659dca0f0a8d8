#include <gtest/gtest.h>
#include <signal.h>

#include <chrono>
#include <cstdio>
#include <thread>

#include "schemas/campaign_reader.hpp"
#include "schemas/files.hpp"
#include "tests/support/tracer_program.hpp"

namespace cupola {
namespace {

Campaign tiny() {
  Campaign campaign = load_campaign(std::filesystem::path(CUPOLA_SOURCE_DIR) / "cases" / "tiny" / "campaign.yaml");
  campaign.tracer.duration = 300;
  campaign.tracer.time_step = 5;
  campaign.tracer.resolve = TracerSettings::Resolve::every_step;  // each equation solved until round-off
  return campaign;
}

struct Difference {
  double position = 0, temperature = 0;
};

/// Largest differences between the tracers of two marches, which must be the same ones.
Difference difference(const testing::FinalTracers& a, const testing::FinalTracers& b) {
  Difference largest;
  EXPECT_EQ(a.id, b.id);
  EXPECT_EQ(a.species, b.species);
  if (a.id != b.id) return {1e9, 1e9};
  for (std::size_t i = 0; i < a.id.size(); ++i) {
    for (std::size_t k = 0; k < 3; ++k)
      largest.position = std::max(largest.position, std::abs(a.position[i][k] - b.position[i][k]));
    largest.temperature =
        std::max(largest.temperature, std::abs(a.temperature[i] - b.temperature[i]) / a.temperature[i]);
  }
  std::printf("%zu tracers: positions differ by %.2g m, temperatures by %.2g\n", a.id.size(), largest.position,
              largest.temperature);
  return largest;
}

testing::FinalTracers marched(const Campaign& campaign, int ranks) {
  const testing::TracerProgram program(campaign, ranks);
  EXPECT_EQ(program.run(), 0) << program.failure();
  return program.tracers();
}

// Paths are exact, sums are taken in the order of the cells, and each linear equation is solved until its residual on
// the undecomposed arrays is round-off; what is left is the order in which ranks' sums are added.
constexpr double position_tolerance = 1e-10;     // m
constexpr double temperature_tolerance = 1e-10;  // relative

TEST(Ranks, OneTwoAndThreeGiveTheSame) {
  Campaign campaign = tiny();
  campaign.tracer.duration = 100;  // differences are largest in the first minutes
  const testing::FinalTracers one = marched(campaign, 1);
  for (const int ranks : {2, 3}) {
    const Difference largest = difference(one, marched(campaign, ranks));
    EXPECT_LT(largest.position, position_tolerance);
    EXPECT_LT(largest.temperature, temperature_tolerance);
  }
}

// By default the flow is solved to a thousandth of the accuracy asked for, on each decomposition in its own way.
TEST(Ranks, LooseSolutionsDifferByLessThanTheAccuracyAllows) {
  Campaign campaign = tiny();
  campaign.tracer.resolve = TracerSettings::Resolve::automatic;
  const Difference largest = difference(marched(campaign, 1), marched(campaign, 2));
  EXPECT_LT(largest.position, position_tolerance);
  EXPECT_LT(largest.temperature, 0.1 * campaign.tracer.accuracy);
}

/// Starts a march on `from` ranks, stops it on the way, and goes on with `to`.
testing::FinalTracers restarted(Campaign campaign, int from, int to) {
  testing::TracerProgram program(campaign, from);
  const pid_t child = program.start();
  for (int k = 0; k < 6000 && !read_progress(program.path()); ++k)
    std::this_thread::sleep_for(std::chrono::milliseconds(5));
  kill(child, SIGUSR1);
  EXPECT_EQ(testing::TracerProgram::wait(child), 75) << "the march was over before it could be stopped";
  program.change_ranks(to);
  EXPECT_EQ(program.run(), 0) << program.failure();
  return program.tracers();
}

void go_on(double time_step, const std::vector<std::pair<int, int>>& changes) {
  Campaign campaign = tiny();
  campaign.tracer.time_step = time_step;  // so short that the march can be stopped on the way
  const testing::FinalTracers one = marched(campaign, 1);
  for (const auto& [from, to] : changes) {
    const Difference largest = difference(one, restarted(campaign, from, to));
    EXPECT_LT(largest.position, position_tolerance);
    EXPECT_LT(largest.temperature, temperature_tolerance);
  }
}

TEST(Ranks, ACheckpointOfNRanksGoesOnOnM) { go_on(2, {{1, 3}}); }
TEST(LongRanks, ACheckpointOfNRanksGoesOnOnM) { go_on(0.5, {{1, 2}, {2, 3}, {3, 2}, {3, 1}}); }

}  // namespace
}  // namespace cupola
