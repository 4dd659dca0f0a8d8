#include <gmock/gmock.h>

#include <cmath>
#include <limits>
#include <random>

#include "raw_files.hpp"
#include "schemas/hdf.hpp"

namespace cupola {
namespace {

using test::failure_of;
using testing::ElementsAre;
using testing::HasSubstr;

class Hdf : public testing::Test {
 protected:
  void SetUp() override {
    HdfWriter writer(file);
    writer.write("Packing/position", position, 3);
    writer.write("Packing/id", id);
    writer.write("Restart/bytes", bytes);
    writer.write("empty", std::vector<double>{});
    writer.write_text("Summary", "{\"µ\": 1}");
    writer.write_text("nothing", "");
    writer.attribute("/", "schema", std::int64_t{1});
    writer.attribute("/", "time", 0.1);
    writer.attribute("/Deep/group", "kind", "dem-result");
    writer.commit();
  }

  TemporaryFolder folder;
  std::filesystem::path file = folder.path() / "a.hdf";
  std::vector<double> position{0.1, -2e-300, std::numeric_limits<double>::infinity(), std::nextafter(1.0, 2.0), 5, 6};
  std::vector<std::int64_t> id{std::numeric_limits<std::int64_t>::min(), 7};
  std::vector<std::uint8_t> bytes{0, 255, 1, 0};
};

TEST_F(Hdf, GivesBackWhatWasWrittenToTheLastBit) {
  const HdfReader reader(file);
  EXPECT_EQ(reader.doubles("Packing/position", 2, 3), position);
  EXPECT_EQ(reader.integers("Packing/id", 2, 1), id);
  EXPECT_EQ(reader.bytes("Restart/bytes"), bytes);
  EXPECT_TRUE(reader.doubles("empty", 0).empty());
  EXPECT_EQ(reader.text("Summary"), "{\"µ\": 1}");
  EXPECT_EQ(reader.text("nothing"), "");
  EXPECT_EQ(reader.integer_attribute("/", "schema"), 1);
  EXPECT_EQ(reader.number_attribute("/", "time"), 0.1);
  EXPECT_EQ(reader.text_attribute("Deep/group", "kind"), "dem-result");
}

TEST_F(Hdf, KnowsWhatIsInIt) {
  const HdfReader reader(file);
  EXPECT_TRUE(reader.has("Packing/position"));
  EXPECT_TRUE(reader.has("/Packing"));
  EXPECT_FALSE(reader.has("Nowhere/position"));
  EXPECT_FALSE(reader.has("Packing/position/x"));
  EXPECT_THAT(reader.names("Packing"), ElementsAre("id", "position"));
  EXPECT_TRUE(reader.names("Nowhere").empty());
  EXPECT_EQ(reader.shape("Packing/position"), std::make_pair(std::size_t{2}, std::size_t{3}));
  EXPECT_EQ(reader.shape("Packing/id"), std::make_pair(std::size_t{2}, std::size_t{1}));
  EXPECT_TRUE(reader.has_attribute("/", "time"));
  EXPECT_FALSE(reader.has_attribute("/", "mesh_hash"));
}

TEST_F(Hdf, NamesFileAndDatasetWhereSomethingIsWrong) {
  const HdfReader reader(file);
  const Failure missing = failure_of([&] { (void)reader.doubles("Packing/mass"); });
  EXPECT_EQ(missing.code(), ExitCode::wrong_input);
  EXPECT_THAT(missing.what(), HasSubstr(file.string()));
  EXPECT_THAT(missing.what(), HasSubstr("'Packing/mass' is missing"));
  EXPECT_EQ(missing.where().at("dataset"), "Packing/mass");
  const Failure length = failure_of([&] { (void)reader.doubles("Packing/position", 5); });
  EXPECT_THAT(length.what(), HasSubstr("has 2 rows where 5 are expected"));
  EXPECT_THAT(failure_of([&] { (void)reader.doubles("Packing/position", 2, 4); }).what(), HasSubstr("has 3 columns"));
  EXPECT_THAT(failure_of([&] { (void)reader.doubles("Packing/id"); }).what(), HasSubstr("floating-point"));
  EXPECT_THAT(failure_of([&] { (void)reader.integers("Packing/position"); }).what(), HasSubstr("whole numbers"));
  EXPECT_THAT(failure_of([&] { (void)reader.bytes("Packing/id"); }).what(), HasSubstr("bytes"));
  EXPECT_THAT(failure_of([&] { (void)reader.doubles("Packing"); }).what(), HasSubstr("'Packing'"));
  EXPECT_EQ(failure_of([&] { (void)reader.text_attribute("/", "schema"); }).code(), ExitCode::wrong_input);
  EXPECT_EQ(failure_of([&] { (void)reader.integer_attribute("/nowhere", "schema"); }).code(), ExitCode::wrong_input);
}

TEST_F(Hdf, LeavesNothingWithoutCommit) {
  const std::string before = test::raw_bytes(file);
  {
    HdfWriter writer(file);
    writer.write("Packing/id", std::vector<std::int64_t>{1});
    EXPECT_EQ(test::raw_bytes(file), before) << "the old file stays until commit";
  }
  EXPECT_EQ(test::raw_bytes(file), before);
  EXPECT_EQ(std::distance(std::filesystem::directory_iterator(folder.path()), {}), 1);
}

TEST_F(Hdf, RefusesMisuse) {
  HdfWriter writer(folder.path() / "b.hdf");
  EXPECT_EQ(failure_of([&] { writer.write("a", std::vector<double>(4), 3); }).code(), ExitCode::input_output);
  writer.write("a", std::vector<double>(3), 3);
  EXPECT_THAT(failure_of([&] { writer.write("a", std::vector<double>(3), 3); }).what(), HasSubstr("'a'"));
  writer.commit();
  EXPECT_THROW(writer.write("b", std::vector<double>(3)), Failure);
  const Failure nowhere = failure_of([&] { HdfWriter(folder.path() / "no/such/folder.hdf"); });
  EXPECT_EQ(nowhere.code(), ExitCode::input_output);
}

TEST_F(Hdf, MissingFileOrGarbageIsAFailure) {
  EXPECT_EQ(failure_of([&] { HdfReader(folder.path() / "none.hdf"); }).code(), ExitCode::input_output);
  EXPECT_EQ(failure_of([&] { HdfReader(folder.path()); }).code(), ExitCode::input_output);
  for (const std::string& content : {std::string(), std::string("task: dem\n"), std::string(5000, '\x89')}) {
    test::write_raw(folder.path() / "garbage.hdf", content);
    const Failure failure = failure_of([&] { HdfReader(folder.path() / "garbage.hdf"); });
    EXPECT_EQ(failure.code(), ExitCode::input_output);
    EXPECT_THAT(failure.what(), HasSubstr("garbage.hdf: not a whole HDF5 file"));
  }
}

TEST_F(Hdf, TruncatedAnywhereIsAFailure) {
  const std::string whole = test::raw_bytes(file);
  for (std::size_t length = 0; length < whole.size(); length += 97) {
    test::write_raw(folder.path() / "cut.hdf", whole.substr(0, length));
    EXPECT_EQ(failure_of([&] { HdfReader(folder.path() / "cut.hdf"); }).code(), ExitCode::input_output)
        << length << " bytes";
  }
}

/// Reads all there is; each dataset may fail, and only by a Failure.
void read_everything(const std::filesystem::path& file) {
  try {
    const HdfReader reader(file);
    for (const char* name : {"Packing/position", "empty"}) {
      try {
        (void)reader.doubles(name);
      } catch (const Failure&) {
      }
    }
    (void)reader.integers("Packing/id");
    (void)reader.bytes("Restart/bytes");
    (void)reader.text("Summary");
    (void)reader.names("Packing");
    (void)reader.text_attribute("Deep/group", "kind");
  } catch (const Failure&) {
  }
}

TEST_F(Hdf, DamagedBytesNeverCrash) {
  const std::string whole = test::raw_bytes(file);
  std::mt19937 random(20190101);
  for (int attempt = 0; attempt < 400; ++attempt) {
    std::string damaged = whole;
    for (int flip = 0; flip < 3; ++flip) {
      damaged[random() % damaged.size()] = static_cast<char>(random());
    }
    test::write_raw(folder.path() / "damaged.hdf", damaged);
    EXPECT_NO_THROW(read_everything(folder.path() / "damaged.hdf")) << "attempt " << attempt;
  }
}

}  // namespace
}  // namespace cupola
