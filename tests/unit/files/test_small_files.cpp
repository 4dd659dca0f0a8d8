#include <gmock/gmock.h>

#include <cmath>
#include <limits>

#include "raw_files.hpp"
#include "schemas/files.hpp"

namespace cupola {
namespace {

using test::failure_of;
using testing::HasSubstr;

/// XXH3-128 of the empty input with seed 0, from xxHash's published test vectors.
TEST(Hash, OfNothingIsThePublishedOne) { EXPECT_EQ(hash_text(""), "xxh3:99aa06d3014798d86001c324468d497f"); }

TEST(Hash, OfAFileIsThatOfItsText) {
  const TemporaryFolder folder;
  for (const std::size_t length : {0U, 1U, 240U, 241U, 3U << 20U}) {
    std::string text(length, 'x');
    test::write_raw(folder.path() / "a", text);
    EXPECT_EQ(hash_file(folder.path() / "a"), hash_text(text));
    text += 'y';
    EXPECT_NE(hash_file(folder.path() / "a"), hash_text(text));
  }
  EXPECT_EQ(failure_of([&] { hash_file(folder.path() / "none"); }).code(), ExitCode::input_output);
}

TEST(AtomicWrite, ReplacesWholeAndLeavesNoTemporary) {
  const TemporaryFolder folder;
  write_text_atomically(folder.path() / "a", "old");
  test::write_raw(temporary_beside(folder.path() / "a"), "left by a killed program, and longer than the new text");
  write_text_atomically(folder.path() / "a", "new");
  EXPECT_EQ(test::raw_bytes(folder.path() / "a"), "new");
  EXPECT_EQ(read_text(folder.path() / "a"), "new");
  EXPECT_FALSE(std::filesystem::exists(temporary_beside(folder.path() / "a")));
}

TEST(AtomicWrite, AFailedWriteKeepsTheOldFile) {
  const TemporaryFolder folder;
  write_text_atomically(folder.path() / "a", "old");
  // A folder in the temporary file's place makes the write fail, for root too.
  std::filesystem::create_directory(temporary_beside(folder.path() / "a"));
  const Failure failure = failure_of([&] { write_text_atomically(folder.path() / "a", "new"); });
  EXPECT_EQ(failure.code(), ExitCode::input_output);
  EXPECT_THAT(failure.what(), HasSubstr("a.part: cannot open"));
  EXPECT_EQ(test::raw_bytes(folder.path() / "a"), "old");
}

TEST(Json, RoundTripAndTornFile) {
  const TemporaryFolder folder;
  const nlohmann::json value = {{"a", 0.1}, {"b", {1, 2}}};
  write_json_atomically(folder.path() / "a.json", value);
  EXPECT_EQ(read_json(folder.path() / "a.json"), value);
  test::write_raw(folder.path() / "a.json", "{\"a\": ");
  const Failure torn = failure_of([&] { read_json(folder.path() / "a.json"); });
  EXPECT_EQ(torn.code(), ExitCode::input_output);
  EXPECT_THAT(torn.what(), HasSubstr("a.json: not whole JSON"));
}

TEST(ProgressFile, RoundTripWithUnknownNumbers) {
  const TemporaryFolder folder;
  EXPECT_FALSE(read_progress(folder.path()));
  Progress progress;
  progress.step = 12345678901;
  progress.process_seconds = 0.1;
  progress.process_seconds_total = std::numeric_limits<double>::quiet_NaN();
  progress.wall_seconds = 3;
  progress.rate = 4;
  progress.phase = "marching";
  progress.monitored = {{"parcels", 3000}, {"mean_solid_temperature", std::numeric_limits<double>::quiet_NaN()}};
  write_progress(folder.path(), progress);
  const std::optional<Progress> read = read_progress(folder.path());
  ASSERT_TRUE(read);
  EXPECT_EQ(read->step, progress.step);
  EXPECT_EQ(read->process_seconds, 0.1);
  EXPECT_TRUE(std::isnan(read->process_seconds_total));
  EXPECT_EQ(read->phase, "marching");
  EXPECT_EQ(read->monitored.at("parcels"), 3000);
  EXPECT_TRUE(std::isnan(read->monitored.at("mean_solid_temperature")));
  test::write_raw(folder.path() / "progress.json", "{\"step\": 1}");
  EXPECT_FALSE(read_progress(folder.path()));
}

TEST(FailureFile, SaysWhereAndWhatToChange) {
  const TemporaryFolder folder;
  EXPECT_FALSE(read_failure(folder.path()));
  write_failure(folder.path(),
                Failure(ExitCode::diverged, "parcel 7 left").at("step", "12").advise("dem.time_step", "5e-6"));
  const nlohmann::json read = read_failure(folder.path()).value();
  EXPECT_EQ(read.at("code"), 70);
  EXPECT_EQ(read.at("sentence"), "parcel 7 left");
  EXPECT_EQ(read.at("where").at("step"), "12");
  EXPECT_EQ(read.at("advice").at("dem.time_step"), "5e-6");
}

TEST(SealedJson, AnyFlippedBitIsFound) {
  const TemporaryFolder folder;
  const std::filesystem::path file = folder.path() / "sealed.json";
  write_sealed_json(file, {{"name", "ofen \u00df"}, {"number", 0.1}, {"list", {1, 2}}});
  EXPECT_EQ(read_sealed_json(file).at("number"), 0.1);
  EXPECT_FALSE(read_sealed_json(file).contains("hash"));
  const std::string content = test::raw_bytes(file);
  for (std::size_t i = 0; i < 8 * content.size(); ++i) {
    std::string flipped = content;
    flipped[i / 8] = static_cast<char>(flipped[i / 8] ^ (1 << (i % 8)));
    test::write_raw(file, flipped);
    EXPECT_EQ(test::failure_of([&] { read_sealed_json(file); }).code(), ExitCode::input_output) << flipped;
  }
}

TEST(SmallFiles, AFailureWrittenByHandNeedsNoSeal) {
  const TemporaryFolder folder;
  test::write_raw(folder.path() / "failure.json", R"({"code": 70, "sentence": "overlap"})");
  EXPECT_EQ(read_failure(folder.path()).value().at("sentence"), "overlap");
}

}  // namespace
}  // namespace cupola
