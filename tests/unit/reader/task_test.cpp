#include "schemas/task.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "schemas/campaign_reader.hpp"
#include "schemas/failure.hpp"
#include "schemas/files.hpp"
#include "schemas/resolved_campaign.hpp"
#include "tests/support/temporary_folder.hpp"
#include "tests/unit/reader/base_campaign.hpp"

namespace cupola {
namespace {

class TaskFile : public testing::Test {
 protected:
  TaskFile() {
    write_text_atomically(folder() / "packing.hdf", "content");
    task.kind = TaskKind::tracer;
    task.episode = 3;
    task.campaign_hash = "xxh3:0123";
    task.program_version = "0.1.0";
    task.random_seed = 18446744073709551615U;
    task.inputs["granular"] = {"packing.hdf", hash_file(folder() / "packing.hdf")};
    task.campaign = read_campaign_text(test::base_campaign, "file").campaign;
  }
  [[nodiscard]] std::filesystem::path folder() const { return temporary.path(); }

  std::string refusal() {
    try {
      read_task(folder());
    } catch (const Failure& failure) {
      EXPECT_EQ(failure.code(), ExitCode::wrong_input);
      return failure.what();
    }
    return "accepted";
  }
  void spoil(const std::string& from, const std::string& to) {
    auto text = read_text(folder() / "task.yaml");
    ASSERT_NE(text.find(from), std::string::npos);
    write_text_atomically(folder() / "task.yaml", text.replace(text.find(from), from.size(), to));
  }

  TemporaryFolder temporary;
  Task task;
};

TEST_F(TaskFile, ReadsBackTheSame) {
  write_task(folder(), task);
  const auto again = read_task(folder());
  EXPECT_EQ(again.kind, task.kind);
  EXPECT_EQ(again.episode, task.episode);
  EXPECT_EQ(again.campaign_hash, task.campaign_hash);
  EXPECT_EQ(again.program_version, task.program_version);
  EXPECT_EQ(again.random_seed, task.random_seed);
  EXPECT_EQ(again.inputs.at("granular").file, "packing.hdf");
  EXPECT_EQ(again.inputs.at("granular").hash, task.inputs.at("granular").hash);
  EXPECT_EQ(resolved_yaml(again.campaign), resolved_yaml(task.campaign));
}

TEST_F(TaskFile, RefusesAChangedOrMissingInput) {
  write_task(folder(), task);
  write_text_atomically(folder() / "packing.hdf", "other content");
  EXPECT_THAT(refusal(), testing::HasSubstr("the input `granular` has another content"));
  std::filesystem::remove(folder() / "packing.hdf");
  EXPECT_THAT(refusal(), testing::HasSubstr("the input `granular` is not there"));
}

TEST_F(TaskFile, RefusesWhatItCannotRead) {
  write_task(folder(), task);
  spoil("schema: 1", "schema: 2");
  EXPECT_THAT(refusal(), testing::HasSubstr("written in file schema 2, this program reads 1"));
  write_task(folder(), task);
  spoil("kind: \"tracer\"", "kind: \"tracker\"");
  EXPECT_THAT(refusal(), testing::HasSubstr("`kind` must be dem, tracer, predict or correct"));
  write_task(folder(), task);
  spoil("campaign_hash:", "campaign_hush:");
  EXPECT_THAT(refusal(), testing::HasSubstr("the key `campaign_hash` is missing"));
  write_task(folder(), task);
  spoil("descent_rate: 0.002", "descent_rate: -0.002");
  EXPECT_THAT(refusal(), testing::HasSubstr("descent_rate: must be at least 0, but is -0.002 m/s"));
  write_text_atomically(folder() / "task.yaml", "{");
  EXPECT_THAT(refusal(), testing::HasSubstr("this is not YAML"));
  write_text_atomically(folder() / "task.yaml", "campaign: 3");
  EXPECT_THAT(refusal(), testing::HasSubstr("is missing"));
}

}  // namespace
}  // namespace cupola
