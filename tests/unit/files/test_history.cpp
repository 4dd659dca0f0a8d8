#include <gmock/gmock.h>

#include <fstream>

#include "raw_files.hpp"
#include "schemas/files.hpp"

namespace cupola {
namespace {

std::vector<long> steps(const std::filesystem::path& folder) {
  std::vector<long> found;
  for (const nlohmann::json& line : read_history(folder)) {
    found.push_back(line.at("step").get<long>());
  }
  return found;
}

TEST(History, IsReadInTheOrderWritten) {
  const TemporaryFolder folder;
  EXPECT_TRUE(read_history(folder.path()).empty());
  for (int step = 0; step < 3; ++step) {
    append_history(folder.path(), {{"step", step}, {"time", 0.1 * step}});
  }
  EXPECT_THAT(steps(folder.path()), testing::ElementsAre(0, 1, 2));
  EXPECT_EQ(read_history(folder.path())[1].at("time"), 0.1);
}

TEST(History, IsCutBackToTheCheckpoint) {
  const TemporaryFolder folder;
  cut_history(folder.path(), 5);
  EXPECT_FALSE(std::filesystem::exists(folder.path() / "history.jsonl"));
  for (int step = 0; step < 10; ++step) {
    append_history(folder.path(), {{"step", step}});
  }
  const std::string undisturbed = test::raw_bytes(folder.path() / "history.jsonl");
  cut_history(folder.path(), 5);
  EXPECT_THAT(steps(folder.path()), testing::ElementsAre(0, 1, 2, 3, 4, 5));
  for (int step = 6; step < 10; ++step) {
    append_history(folder.path(), {{"step", step}});
  }
  EXPECT_EQ(test::raw_bytes(folder.path() / "history.jsonl"), undisturbed) << "cut and gone on: as if never stopped";
  cut_history(folder.path(), -1);
  EXPECT_TRUE(read_history(folder.path()).empty());
}

/// A kill may tear the last line after any byte.
TEST(History, ToleratesATornLastLine) {
  const TemporaryFolder folder;
  const std::string whole = "{\"step\":1}\n{\"step\":2}\n";
  const std::string last = "{\"step\":3}";
  for (std::size_t length = 0; length < last.size(); ++length) {
    test::write_raw(folder.path() / "history.jsonl", whole + last.substr(0, length));
    EXPECT_THAT(steps(folder.path()), testing::ElementsAre(1, 2)) << length;
    cut_history(folder.path(), 2);
    EXPECT_EQ(test::raw_bytes(folder.path() / "history.jsonl"), whole) << length;
    append_history(folder.path(), {{"step", 3}});
    EXPECT_THAT(steps(folder.path()), testing::ElementsAre(1, 2, 3)) << length;
  }
}

}  // namespace
}  // namespace cupola
