#include <gmock/gmock.h>

#include "raw_files.hpp"
#include "schemas/files.hpp"

namespace cupola {
namespace {

using test::failure_of;
using testing::HasSubstr;

class Manifest : public testing::Test {
 protected:
  void SetUp() override {
    std::filesystem::create_directories(folder.path() / "foam/constant/polyMesh");
    for (const std::string& name : listed) {
      test::write_raw(folder.path() / name, "content of " + name);
    }
    for (const std::string& name : changing) {
      test::write_raw(folder.path() / name, "content of " + name);
    }
    write_manifest(folder.path());
  }

  TemporaryFolder folder;
  std::vector<std::string> listed{"task.yaml", "result.hdf", "history.jsonl", "foam/mesh.hdf", "foam/wall.stl"};
  std::vector<std::string> changing{"lock",
                                    "progress.json",
                                    "stage.log",
                                    "checkpoint-A.h5",
                                    "checkpoint-A.hash",
                                    "log.grain",
                                    "result.hdf.part",
                                    "foam/case.foam",
                                    "foam/constant/polyMesh/points"};
};

TEST_F(Manifest, AnUntouchedFolderPasses) {
  EXPECT_TRUE(has_manifest(folder.path()));
  EXPECT_NO_THROW(verify_manifest(folder.path()));
  EXPECT_EQ(read_json(folder.path() / "manifest.json").at("files").size(), listed.size());
}

TEST_F(Manifest, OneFlippedBitIsFound) {
  for (const std::string& name : listed) {
    const std::string content = test::raw_bytes(folder.path() / name);
    std::string flipped = content;
    flipped[3] = static_cast<char>(flipped[3] ^ 1);
    test::write_raw(folder.path() / name, flipped);
    const Failure failure = failure_of([&] { verify_manifest(folder.path()); });
    EXPECT_EQ(failure.code(), ExitCode::input_output);
    EXPECT_THAT(failure.what(), HasSubstr((folder.path() / name).string() + ": other content"));
    test::write_raw(folder.path() / name, content);
    EXPECT_NO_THROW(verify_manifest(folder.path()));
  }
}

TEST_F(Manifest, OneFlippedBitOfItselfIsFound) {
  const std::string content = test::raw_bytes(folder.path() / "manifest.json");
  for (std::size_t i = 0; i < 8 * content.size(); ++i) {
    std::string flipped = content;
    flipped[i / 8] = static_cast<char>(flipped[i / 8] ^ (1 << (i % 8)));
    test::write_raw(folder.path() / "manifest.json", flipped);
    EXPECT_THAT(failure_of([&] { verify_manifest(folder.path()); }).what(), HasSubstr("manifest.json: damaged"));
  }
}

TEST_F(Manifest, AllThatDiffersIsListed) {
  EXPECT_TRUE(manifest_problems(folder.path()).empty());
  test::write_raw(folder.path() / "result.hdf", "x");
  std::filesystem::remove(folder.path() / "task.yaml");
  EXPECT_EQ(manifest_problems(folder.path()).size(), 2U);
}

TEST_F(Manifest, AMissingOrTruncatedFileIsFound) {
  test::write_raw(folder.path() / "result.hdf", "content");
  EXPECT_THAT(failure_of([&] { verify_manifest(folder.path()); }).what(), HasSubstr("result.hdf: another size"));
  std::filesystem::remove(folder.path() / "result.hdf");
  EXPECT_THAT(failure_of([&] { verify_manifest(folder.path()); }).what(), HasSubstr("result.hdf: missing"));
}

TEST_F(Manifest, WhatGoesOnChangingIsLeftOut) {
  for (const std::string& name : changing) {
    test::write_raw(folder.path() / name, "other");
  }
  EXPECT_NO_THROW(verify_manifest(folder.path()));
}

TEST_F(Manifest, ADamagedManifestIsAFailure) {
  for (const char* content : {"", "{\"files\": {\"task.yaml\"", "[]", "{\"files\": {\"task.yaml\": 3}}"}) {
    test::write_raw(folder.path() / "manifest.json", content);
    EXPECT_EQ(failure_of([&] { verify_manifest(folder.path()); }).code(), ExitCode::input_output) << content;
  }
}

}  // namespace
}  // namespace cupola
