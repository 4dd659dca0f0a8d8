#include "orchestrator/run_folder.hpp"

#include <gmock/gmock.h>

#include <fstream>

#include "orchestrator/campaign_difference.hpp"
#include "orchestrator/run_status.hpp"
#include "schemas/campaign_reader.hpp"
#include "schemas/resolved_campaign.hpp"
#include "tests/support/temporary_folder.hpp"

namespace {

using cupola::ExitCode;
using cupola::Failure;
using cupola::RunFolder;
using cupola::TemporaryFolder;
using ::testing::HasSubstr;

const std::filesystem::path tiny = std::filesystem::path(CUPOLA_SOURCE_DIR) / "cases/tiny/campaign.yaml";

/// The failure of a call. Fails the test where it does not fail.
template <class Call>
Failure failure_of(const Call& call) {
  try {
    call();
  } catch (const Failure& failure) {
    return failure;
  }
  ADD_FAILURE() << "no failure";
  return {ExitCode::done, ""};
}

/// The tiny campaign with a piece of its text replaced.
std::filesystem::path changed_tiny(const TemporaryFolder& folder, const std::string& old_text,
                                   const std::string& new_text) {
  std::string text = cupola::read_text(tiny);
  text.replace(text.find(old_text), old_text.size(), new_text);
  std::ofstream(folder.path() / "changed.yaml") << text;
  return folder.path() / "changed.yaml";
}

TEST(RunFolder, FreezesTheCampaign) {
  const TemporaryFolder folder;
  const auto run_path = folder.path() / "a/b";
  {
    const auto run = RunFolder::for_campaign(tiny, run_path);
    EXPECT_EQ(run->campaign().name, "tiny");
    EXPECT_EQ(run->campaign_hash(), cupola::hash_file(tiny));
  }
  EXPECT_EQ(cupola::read_text(run_path / "campaign.yaml"), cupola::read_text(tiny));
  const auto record = cupola::read_run(run_path);
  EXPECT_EQ(cupola::resolved_yaml(record.campaign), cupola::resolved_yaml(cupola::load_campaign(tiny)));
  EXPECT_EQ(record.journal.size(), 1U);
}

TEST(RunFolder, IsOpenedAgainByTheSameCampaignWrittenOtherwise) {
  const TemporaryFolder folder;
  RunFolder::for_campaign(tiny, folder.path() / "run");
  const auto again =
      RunFolder::for_campaign(changed_tiny(folder, "tiny\n", "tiny  # the same\n"), folder.path() / "run");
  EXPECT_EQ(again->campaign_hash(), cupola::hash_file(tiny)) << "the frozen one counts";
}

TEST(RunFolder, OfAnotherCampaignIsRefusedAndTheKeysNamed) {
  const TemporaryFolder folder;
  RunFolder::for_campaign(tiny, folder.path() / "run");
  const auto other = changed_tiny(folder, "descent_rate: 2 mm/s", "descent_rate: 3 mm/s");
  const Failure failure = failure_of([&] { RunFolder::for_campaign(other, folder.path() / "run"); });
  EXPECT_EQ(failure.code(), ExitCode::wrong_input);
  EXPECT_THAT(failure.what(), HasSubstr("descent_rate: 0.002 there, 0.003 here"));
  EXPECT_EQ(cupola::read_text(folder.path() / "run/campaign.yaml"), cupola::read_text(tiny));
}

TEST(RunFolder, WithSomethingElseInItIsRefused) {
  const TemporaryFolder folder;
  std::ofstream(folder.path() / "thesis.tex") << "ten years of work";
  const Failure failure = failure_of([&] { RunFolder::for_campaign(tiny, folder.path()); });
  EXPECT_EQ(failure.code(), ExitCode::wrong_input);
  EXPECT_FALSE(std::filesystem::exists(folder.path() / "campaign.yaml"));
}

TEST(RunFolder, BegunAndKilledIsBegunAgain) {
  const TemporaryFolder folder;
  std::ofstream(folder.path() / "campaign.yaml") << "half a ca";
  std::ofstream(folder.path() / "resolved.yaml.part") << "x";
  EXPECT_EQ(RunFolder::for_campaign(tiny, folder.path())->campaign().name, "tiny");
}

TEST(RunFolder, TakesOneWriter) {
  const TemporaryFolder folder;
  const auto first = RunFolder::for_campaign(tiny, folder.path() / "run");
  EXPECT_EQ(failure_of([&] { RunFolder::open(folder.path() / "run"); }).code(), ExitCode::held);
  EXPECT_EQ(cupola::run_status(cupola::read_run(folder.path() / "run"))["state"], "running");
}

TEST(RunFolder, ChangedAfterItBeganIsRefused) {
  for (const char* name : {"campaign.yaml", "resolved.yaml"}) {
    const TemporaryFolder folder;
    RunFolder::for_campaign(tiny, folder.path() / "run");
    std::ofstream(folder.path() / "run" / name, std::ios::app) << "# later thought\n";
    EXPECT_EQ(failure_of([&] { RunFolder::open(folder.path() / "run"); }).code(), ExitCode::wrong_input);
  }
}

TEST(RunFolder, WithAChangedInformationFileIsRefused) {
  const TemporaryFolder folder;
  RunFolder::for_campaign(tiny, folder.path() / "run");
  const std::string text = cupola::read_text(folder.path() / "run/run.json");
  for (std::size_t i = 0; i < text.size(); i += 7) {
    std::string flipped = text;
    flipped[i] = static_cast<char>(flipped[i] ^ 1);
    std::ofstream(folder.path() / "run/run.json") << flipped;
    EXPECT_EQ(failure_of([&] { RunFolder::open(folder.path() / "run"); }).code(), ExitCode::input_output);
  }
}

TEST(RunFolder, WithAnotherCampaignsJournalIsRefused) {
  const TemporaryFolder folder;
  RunFolder::for_campaign(tiny, folder.path() / "one");
  RunFolder::for_campaign(changed_tiny(folder, "2 mm/s", "3 mm/s"), folder.path() / "two");
  std::filesystem::copy_file(folder.path() / "two/journal.jsonl", folder.path() / "one/journal.jsonl",
                             std::filesystem::copy_options::overwrite_existing);
  EXPECT_EQ(failure_of([&] { RunFolder::open(folder.path() / "one"); }).code(), ExitCode::wrong_input);
}

TEST(RunFolder, ThatIsNoneSaysHowToBegin) {
  const TemporaryFolder folder;
  const Failure failure = failure_of([&] { RunFolder::open(folder.path()); });
  EXPECT_EQ(failure.code(), ExitCode::wrong_input);
  EXPECT_THAT(failure.what(), HasSubstr("cupola run"));
}

TEST(ChangedKey, IsCheckedLikeAnyCampaign) {
  const cupola::Campaign campaign = cupola::load_campaign(tiny);
  EXPECT_EQ(cupola::with_changed_key(campaign, "dem.time_step", "1e-5").dem.time_step, 1e-5);
  EXPECT_EQ(cupola::with_changed_key(campaign, "tracer.time_step", "2 s").tracer.time_step, 2.);
  EXPECT_EQ(failure_of([&] { cupola::with_changed_key(campaign, "dem.time_stop", "1"); }).code(),
            ExitCode::wrong_input);
  EXPECT_EQ(failure_of([&] { cupola::with_changed_key(campaign, "dam.time_step", "1"); }).code(),
            ExitCode::wrong_input);
  EXPECT_EQ(failure_of([&] { cupola::with_changed_key(campaign, "dem.time_step", "5 m"); }).code(),
            ExitCode::wrong_input);
}

}  // namespace
