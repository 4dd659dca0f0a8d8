#include "orchestrator/journal.hpp"

#include <gtest/gtest.h>

#include <fstream>

#include "schemas/files.hpp"
#include "tests/support/temporary_folder.hpp"

namespace {

using cupola::ExitCode;
using cupola::Failure;
using cupola::Journal;
using cupola::read_journal;
using cupola::read_text;
using cupola::TemporaryFolder;

/// Three records in a file; gives the file's text.
std::string three_records(const std::filesystem::path& file) {
  Journal journal(file);
  journal.append("campaign-started", {{"campaign", "slot"}});
  journal.append("stage-started", {{"episode", 1}, {"stage", "dem"}});
  journal.append("stage-finished", {{"episode", 1}, {"stage", "dem"}, {"wall_seconds", 0.1}});
  return read_text(file);
}

void put(const std::filesystem::path& file, const std::string& text) {
  std::ofstream(file, std::ios::binary | std::ios::trunc) << text;
}

TEST(Journal, KeepsItsRecordsInOrder) {
  const TemporaryFolder folder;
  three_records(folder.path() / "journal.jsonl");
  const auto records = read_journal(folder.path() / "journal.jsonl");
  ASSERT_EQ(records.size(), 3U);
  EXPECT_EQ(records[0]["event"], "campaign-started");
  EXPECT_EQ(records[2]["wall_seconds"], 0.1);
  EXPECT_EQ(records[1]["number"], 2);
}

TEST(Journal, DropsALineTornAtAnyPlaceAndGoesOn) {
  const TemporaryFolder folder;
  const auto file = folder.path() / "journal.jsonl";
  const std::string whole = three_records(file);
  const std::size_t last = whole.rfind('\n', whole.size() - 2) + 1;
  for (std::size_t length = last; length < whole.size(); ++length) {
    put(file, whole.substr(0, length));
    EXPECT_EQ(read_journal(file).size(), 2U) << "cut at byte " << length;
    Journal journal(file);
    EXPECT_EQ(journal.records().size(), 2U);
    journal.append("stage-started", {{"episode", 1}});
    EXPECT_EQ(read_journal(file).size(), 3U);
  }
}

TEST(Journal, ReadingChangesNothing) {
  const TemporaryFolder folder;
  const auto file = folder.path() / "journal.jsonl";
  const std::string whole = three_records(file);
  put(file, whole.substr(0, whole.size() - 5));
  read_journal(file);
  EXPECT_EQ(read_text(file), whole.substr(0, whole.size() - 5));
}

TEST(Journal, FindsEveryChangedByte) {
  const TemporaryFolder folder;
  const auto file = folder.path() / "journal.jsonl";
  const std::string whole = three_records(file);
  for (std::size_t i = 0; i < whole.size(); ++i) {
    std::string changed = whole;
    changed[i] = static_cast<char>(changed[i] ^ 1);
    put(file, changed);
    EXPECT_THROW(read_journal(file), Failure) << "byte " << i << " of " << whole.size();
    EXPECT_THROW(Journal{file}, Failure) << "byte " << i;
  }
}

TEST(Journal, FindsAMissingAndASwappedLine) {
  const TemporaryFolder folder;
  const auto file = folder.path() / "journal.jsonl";
  const std::string whole = three_records(file);
  const std::size_t first = whole.find('\n') + 1, second = whole.find('\n', first) + 1;
  const std::string a = whole.substr(0, first), b = whole.substr(first, second - first), c = whole.substr(second);
  for (const std::string& wrong : {b + c, a + c, a + c + b, b + a + c, a + b + b + c}) {
    put(file, wrong);
    EXPECT_THROW(read_journal(file), Failure);
  }
}

TEST(Journal, SaysWhichLine) {
  const TemporaryFolder folder;
  const auto file = folder.path() / "journal.jsonl";
  std::string text = three_records(file);
  text.replace(text.find("\"dem\""), 5, "\"dam\"");
  put(file, text);
  try {
    read_journal(file);
    FAIL();
  } catch (const Failure& failure) {
    EXPECT_EQ(failure.code(), ExitCode::wrong_input);
    EXPECT_NE(std::string(failure.what()).find("journal.jsonl:2:"), std::string::npos) << failure.what();
  }
}

TEST(Journal, ThatCannotBeWrittenIsAFailure) {
  const TemporaryFolder folder;
  EXPECT_THROW(Journal{folder.path() / "nowhere/journal.jsonl"}, Failure);
}

TEST(Time, ComesBackFromItsText) {
  EXPECT_DOUBLE_EQ(cupola::seconds_since_epoch("1970-01-02T00:00:01.250Z"), 86401.25);
  const double now = cupola::seconds_since_epoch(cupola::utc_now());
  EXPECT_NEAR(now, static_cast<double>(std::time(nullptr)), 2);
  EXPECT_THROW(cupola::seconds_since_epoch("yesterday"), Failure);
}

}  // namespace
