#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "schemas/campaign_reader.hpp"
#include "schemas/resolved_campaign.hpp"
#include "tests/unit/reader/base_campaign.hpp"

namespace cupola {
namespace {

ReadCampaign read_with(const std::string& launch) {
  return read_campaign_text(test::base_campaign + "launch: " + launch + "\n", "file");
}

std::string complaint_about(const std::string& launch) { return to_text(read_with(launch).errors); }

TEST(Launch, OfSlurmIsReadAndReadBack) {
  const auto read = read_with(
      "{slurm: {partition: batch, ranks: 64, time: 24 h, checkpoint_before: 20 min, account: furnace, qos: normal, "
      "nodes: 2, starter: srun, options: [--mem=16G, --exclusive], setup: [module load openmpi]}}");
  ASSERT_TRUE(read.ok()) << to_text(read.errors);
  const Launch& launch = read.campaign.launch;
  EXPECT_EQ(launch.ranks, 64);
  ASSERT_TRUE(launch.slurm);
  EXPECT_DOUBLE_EQ(launch.slurm->time, 86400);
  EXPECT_DOUBLE_EQ(launch.slurm->checkpoint_before, 1200);
  EXPECT_EQ(launch.slurm->partition, "batch");
  EXPECT_EQ(launch.slurm->account, "furnace");
  EXPECT_EQ(launch.slurm->qos, "normal");
  EXPECT_EQ(launch.slurm->nodes, 2);
  EXPECT_EQ(launch.slurm->starter, SlurmLaunch::Starter::srun);
  EXPECT_THAT(launch.slurm->options, testing::ElementsAre("--mem=16G", "--exclusive"));
  EXPECT_THAT(launch.slurm->setup, testing::ElementsAre("module load openmpi"));
  const auto again = read_campaign_text(resolved_yaml(read.campaign), "resolved");
  ASSERT_TRUE(again.ok()) << to_text(again.errors);
  EXPECT_EQ(resolved_json(again.campaign), resolved_json(read.campaign));
}

TEST(Launch, AsksForTheCheckpointAQuarterBeforeAShortLimit) {
  EXPECT_DOUBLE_EQ(read_with("{slurm: {ranks: 1, time: 24 h}}").campaign.launch.slurm->checkpoint_before, 600);
  EXPECT_DOUBLE_EQ(read_with("{slurm: {ranks: 1, time: 20 min}}").campaign.launch.slurm->checkpoint_before, 300);
}

TEST(Launch, RefusesWhatCannotBe) {
  using testing::HasSubstr;
  EXPECT_THAT(complaint_about("{ranks: 2, slurm: {ranks: 2, time: 1 h}}"),
              HasSubstr("launch: expected at most 1 of: ranks, slurm"));
  EXPECT_THAT(complaint_about("{slurm: {ranks: 2}}"), HasSubstr("launch.slurm: the key `time` is missing"));
  EXPECT_THAT(complaint_about("{slurm: {ranks: 2, time: 30 s}}"), HasSubstr("must be at least 60"));
  EXPECT_THAT(complaint_about("{slurm: {ranks: 2, time: 1 h, checkpoint_before: 2 h}}"),
              HasSubstr("7200 s before the limit is before the job begins: its limit is 3600 s"));
  EXPECT_THAT(complaint_about("{slurm: {ranks: 2, time: 1 h, options: [--partition=fast]}}"),
              HasSubstr("launch.slurm.options[0]: --partition is set by `launch.slurm.partition`: use that"));
  EXPECT_THAT(complaint_about("{slurm: {ranks: 2, time: 1 h, options: [--requeue]}}"),
              HasSubstr("cupola sets --requeue itself: leave it out"));
  EXPECT_THAT(complaint_about("{slurm: {ranks: 2, time: 1 h, options: [-p fast]}}"), HasSubstr("is no name here"));
  EXPECT_THAT(complaint_about("{slurm: {ranks: 2, time: 1 h, partition: a b}}"), HasSubstr("is no name here"));
  EXPECT_THAT(complaint_about("{slurm: {ranks: 2, time: 1 h, starter: srunn}}"), HasSubstr("did you mean `srun`?"));
}

}  // namespace
}  // namespace cupola
