#include "orchestrator/stage_state.hpp"

#include <gtest/gtest.h>
#include <unistd.h>

#include <fstream>

#include "orchestrator/prepared_case.hpp"
#include "orchestrator/run_folder.hpp"
#include "orchestrator/stage_task.hpp"
#include "schemas/campaign_reader.hpp"
#include "schemas/files.hpp"
#include "tests/support/temporary_folder.hpp"

namespace {

using cupola::Failure;
using cupola::stage_state;
using cupola::StageState;
using cupola::TaskKind;
using cupola::TemporaryFolder;
using Condition = StageState::Condition;
using nlohmann::json;

std::filesystem::path begun(const TemporaryFolder& run, int attempt) {
  const auto folder = cupola::task_folder(run.path(), 2, TaskKind::dem, attempt);
  std::filesystem::create_directories(folder);
  return folder;
}

StageState state_of(const TemporaryFolder& run, const std::vector<json>& journal = {}) {
  return stage_state(run.path(), journal, 2, TaskKind::dem);
}

json record(const std::string& event, int attempt) {
  return {{"event", event}, {"episode", 2}, {"stage", "dem"}, {"attempt", attempt}};
}

TEST(StageState, IsAbsentBeforeItsFolder) {
  const TemporaryFolder run;
  const auto state = state_of(run);
  EXPECT_EQ(state.condition, Condition::absent);
  EXPECT_EQ(state.folder, run.path() / "episodes/002/dem/attempt-1");
}

TEST(StageState, IsInterruptedWithoutManifest) {
  const TemporaryFolder run;
  begun(run, 1);
  EXPECT_EQ(state_of(run).condition, Condition::interrupted);
}

TEST(StageState, IsFinishedWithManifestWhetherTheJournalKnowsOrNot) {
  const TemporaryFolder run;
  cupola::write_manifest(begun(run, 1));
  EXPECT_EQ(state_of(run).condition, Condition::finished);
  EXPECT_FALSE(state_of(run).finished_record);
  EXPECT_TRUE(state_of(run, {record("stage-finished", 1)}).finished_record);
  EXPECT_FALSE(state_of(run, {record("stage-finished", 2)}).finished_record) << "of another attempt";
}

TEST(StageState, FailsOnlyWhereTheNumbersWentBad) {
  const TemporaryFolder run;
  const auto folder = begun(run, 1);
  cupola::write_failure(folder, Failure(cupola::ExitCode::input_output, "disk full"));
  EXPECT_EQ(state_of(run).condition, Condition::interrupted);
  cupola::write_failure(folder, Failure(cupola::ExitCode::diverged, "overlap").advise("dem.time_step", "1e-5"));
  EXPECT_EQ(state_of(run).condition, Condition::failed);
  EXPECT_EQ((*state_of(run).failure)["advice"]["dem.time_step"], "1e-5");
}

TEST(StageState, IsThatOfItsLatestAttempt) {
  const TemporaryFolder run;
  cupola::write_failure(begun(run, 1), Failure(cupola::ExitCode::diverged, "overlap"));
  begun(run, 2);
  EXPECT_EQ(state_of(run).condition, Condition::interrupted);
  EXPECT_EQ(state_of(run).attempt, 2);
}

TEST(StageState, FindsWhoeverWorksInTheTaskFolder) {
  const TemporaryFolder run;
  const auto folder = begun(run, 1);
  const cupola::FolderLock lock(folder);
  EXPECT_EQ(state_of(run).condition, Condition::running);
}

TEST(StageState, FindsAStageThatHasNotTakenItsLockYet) {
  const TemporaryFolder run;
  begun(run, 1);
  const auto self = cupola::ProcessIdentity::of(::getpid());
  json started = record("stage-started", 1);
  started["host"] = self.host;
  started["pid"] = self.pid;
  started["process_started"] = self.started;
  EXPECT_EQ(state_of(run, {started}).condition, Condition::running);
  EXPECT_EQ(state_of(run, {started}).process->pid, ::getpid());
  started["process_started"] = self.started - 1;
  EXPECT_EQ(state_of(run, {started}).condition, Condition::interrupted) << "the number belongs to another process now";
}

TEST(Advice, IsKeptInItsOrder) {
  json first = record("advice-taken", 2), second = record("advice-taken", 3);
  first["changes"] = {{"dem.time_step", "2e-5"}};
  second["changes"] = {{"dem.time_step", "1e-5"}};
  const std::vector<std::pair<std::string, std::string>> expected = {{"dem.time_step", "2e-5"},
                                                                     {"dem.time_step", "1e-5"}};
  EXPECT_EQ(cupola::advice_taken({first, record("stage-failed", 2), second}), expected);
}

TEST(StageSeed, DiffersByStageAndStaysTheSame) {
  const auto seed = cupola::stage_seed(1, 1, TaskKind::dem);
  EXPECT_EQ(seed, cupola::stage_seed(1, 1, TaskKind::dem));
  EXPECT_NE(seed, cupola::stage_seed(2, 1, TaskKind::dem));
  EXPECT_NE(seed, cupola::stage_seed(1, 2, TaskKind::dem));
  EXPECT_NE(seed, cupola::stage_seed(1, 1, TaskKind::tracer));
  EXPECT_LT(seed, std::uint64_t{1} << 53U);
}

/// A task folder in a run, with one input.
class TaskFolder : public ::testing::Test {
 protected:
  TaskFolder() {
    std::ofstream(run_.path() / "packing.hdf") << "parcels";
    folder_ = cupola::task_folder(run_.path(), 2, TaskKind::dem, 1);
  }
  cupola::Task task(const std::string& campaign_hash) {
    return cupola::stage_task(TaskKind::dem, 2, campaign_, campaign_hash, {{"packing", run_.path() / "packing.hdf"}},
                              folder_);
  }
  TemporaryFolder run_;
  std::filesystem::path folder_;
  cupola::Campaign campaign_ =
      cupola::load_campaign(std::filesystem::path(CUPOLA_SOURCE_DIR) / "cases/tiny/campaign.yaml");
};

TEST_F(TaskFolder, IsReadBackAsItWasWritten) {
  cupola::ensure_task(folder_, task("xxh3:a"));
  const cupola::Task read = cupola::read_task(folder_);
  EXPECT_EQ(read.inputs.at("packing").file, "../../../../packing.hdf");
  EXPECT_EQ(read.random_seed, cupola::stage_seed(1, 2, TaskKind::dem));
  cupola::ensure_task(folder_, task("xxh3:a"));  // a resume finds the same
}

TEST_F(TaskFolder, OfAnotherCampaignIsRefusedAndKept) {
  cupola::ensure_task(folder_, task("xxh3:a"));
  const std::string before = cupola::read_text(folder_ / "task.yaml");
  EXPECT_THROW(cupola::ensure_task(folder_, task("xxh3:b")), Failure);
  EXPECT_EQ(cupola::read_text(folder_ / "task.yaml"), before);
}

TEST_F(TaskFolder, WhoseTaskIsNotTheOneTheJournalKnowsIsRefused) {
  cupola::ensure_task(folder_, task("xxh3:a"));
  const std::string hash = cupola::hash_file(folder_ / "task.yaml");
  cupola::ensure_task(folder_, task("xxh3:a"), hash);
  const std::string text = cupola::read_text(folder_ / "task.yaml");
  for (std::size_t i = 0; i < text.size(); i += 101) {
    std::string flipped = text;
    flipped[i] = static_cast<char>(flipped[i] ^ 1);
    std::ofstream(folder_ / "task.yaml") << flipped;
    EXPECT_THROW(cupola::ensure_task(folder_, task("xxh3:a"), hash), Failure);
  }
  std::filesystem::remove(folder_ / "task.yaml");
  EXPECT_THROW(cupola::ensure_task(folder_, task("xxh3:a"), hash), Failure);
}

TEST_F(TaskFolder, IsKnownByItsCase) {
  std::filesystem::create_directories(folder_ / "foam/constant");
  std::ofstream(folder_ / "foam/constant/points") << "0 0 0";
  std::ofstream(folder_ / "foam/log.blockMesh") << "today";
  const auto condition = [&](const std::vector<json>& journal, int ranks) {
    return cupola::case_condition(journal, 2, TaskKind::dem, 1, folder_, ranks);
  };
  EXPECT_EQ(condition({}, 2), cupola::CaseCondition::missing);
  json prepared = record("stage-prepared", 1);
  prepared["ranks"] = 2;
  prepared["case_hash"] = cupola::case_fingerprint(folder_ / "foam");
  std::ofstream(folder_ / "foam/log.blockMesh") << "tomorrow";
  EXPECT_EQ(condition({prepared}, 2), cupola::CaseCondition::ready);
  EXPECT_EQ(condition({prepared}, 3), cupola::CaseCondition::missing) << "for another number of ranks";
  std::ofstream(folder_ / "foam/constant/points") << "0 0 1";
  EXPECT_EQ(condition({prepared}, 2), cupola::CaseCondition::damaged);
}

TEST(StageState, CountsTheWallTimeOfAllAttempts) {
  const TemporaryFolder run;
  for (const int attempt : {1, 2}) {
    cupola::Progress progress;
    progress.wall_seconds = 10. * attempt;
    cupola::write_progress(begun(run, attempt), progress);
  }
  EXPECT_EQ(cupola::wall_seconds_of_stage(run.path(), 2, TaskKind::dem), 30.);
}

TEST(RanksInForce, AreTheCampaignsUntilToldOtherwise) {
  EXPECT_EQ(cupola::ranks_in_force({}, 4), 4);
  EXPECT_EQ(cupola::ranks_in_force({{{"event", "ranks-changed"}, {"ranks", 2}}, {{"event", "x"}}}, 4), 2);
}

TEST_F(TaskFolder, WhoseInputWasSwappedIsRefused) {
  cupola::ensure_task(folder_, task("xxh3:a"));
  std::ofstream(run_.path() / "packing.hdf") << "other parcels";
  EXPECT_THROW(cupola::ensure_task(folder_, task("xxh3:a")), Failure);
}

}  // namespace
