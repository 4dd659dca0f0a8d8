#include <gmock/gmock.h>

#include <cstdlib>
#include <fstream>
#include <iostream>
#include <random>

#include "orchestrator/journal.hpp"
#include "orchestrator/run_check.hpp"
#include "orchestrator/run_folder.hpp"
#include "orchestrator/stage_state.hpp"
#include "orchestrator/study/study_file.hpp"
#include "schemas/checkpoint_seal.hpp"
#include "schemas/files.hpp"
#include "tests/support/temporary_folder.hpp"

/// Flipped bits in a real campaign's run folder (environment CUPOLA_FAULT_RUN): each is found, and the file named.
namespace {

namespace fs = std::filesystem;
using cupola::Failure;
using testing::HasSubstr;

/// A file with one bit flipped, whole again at the end of the object's life.
class FlippedBit {
 public:
  FlippedBit(fs::path file, std::uintmax_t byte, int bit) : file_(std::move(file)), byte_(byte), bit_(bit) { flip(); }
  ~FlippedBit() { flip(); }
  FlippedBit(const FlippedBit&) = delete;
  FlippedBit& operator=(const FlippedBit&) = delete;
  FlippedBit(FlippedBit&&) = delete;
  FlippedBit& operator=(FlippedBit&&) = delete;

 private:
  void flip() {
    std::fstream stream(file_, std::ios::in | std::ios::out | std::ios::binary);
    stream.seekg(static_cast<std::streamoff>(byte_));
    const int old = stream.get();
    stream.seekp(static_cast<std::streamoff>(byte_));
    stream.put(static_cast<char>(old ^ (1 << bit_)));
  }

  fs::path file_;
  std::uintmax_t byte_;
  int bit_;
};

class Damage : public testing::Test {
 protected:
  void SetUp() override {
    const char* run = std::getenv("CUPOLA_FAULT_RUN");
    ASSERT_NE(run, nullptr) << "CUPOLA_FAULT_RUN names the run folder of the undisturbed campaign";
    run_ = folder_.path() / "run";
    fs::copy(run, run_, fs::copy_options::recursive);
    const char* seed = std::getenv("CUPOLA_FAULT_SEED");
    const auto used = seed != nullptr ? std::strtoul(seed, nullptr, 10) : std::random_device{}();
    std::cout << "seed " << used << "\n";
    random_.seed(static_cast<std::mt19937::result_type>(used));
  }

  /// Positions in a file: its ends and some by chance.
  std::vector<std::uintmax_t> positions(const fs::path& file, int by_chance) {
    const std::uintmax_t size = fs::file_size(file);
    std::vector<std::uintmax_t> result{0, size / 2, size - 1};
    for (int i = 0; i < by_chance; ++i)
      result.push_back(std::uniform_int_distribution<std::uintmax_t>(0, size - 1)(random_));
    return result;
  }

  int bit() { return std::uniform_int_distribution<int>(0, 7)(random_); }

  cupola::TemporaryFolder folder_;
  fs::path run_;
  std::mt19937 random_;
};

TEST_F(Damage, OfAnyFileNamedInAManifestIsFound) {
  int flipped = 0;
  for (const auto& entry : fs::recursive_directory_iterator(run_)) {
    if (entry.path().filename() != "manifest.json") continue;
    const fs::path task = entry.path().parent_path();
    std::vector<fs::path> files{entry.path()};
    const nlohmann::json manifest = cupola::read_sealed_json(entry.path());
    for (const auto& [name, expected] : manifest["files"].items()) files.push_back(task / name);
    EXPECT_GE(files.size(), 6U) << "result, history, task, mesh and walls at least";
    for (const fs::path& file : files) {
      for (const std::uintmax_t byte : positions(file, 5)) {
        const FlippedBit damage(file, byte, bit());
        ++flipped;
        // At the next use, and by `cupola verify`.
        EXPECT_THROW(cupola::verify_manifest(task), Failure) << file << " byte " << byte;
        EXPECT_THAT(cupola::manifest_problems(task), testing::Contains(HasSubstr(file.filename().string())));
      }
    }
    EXPECT_NO_THROW(cupola::verify_manifest(task));
  }
  std::cout << flipped << " of " << flipped << " flipped bits found in files of manifests\n";
  EXPECT_GT(flipped, 100);
}

TEST_F(Damage, OfTheJournalAndTheFrozenFilesIsFound) {
  int flipped = 0;
  for (const char* name : {"journal.jsonl", "run.json", "campaign.yaml", "resolved.yaml"}) {
    const fs::path file = run_ / name;
    for (const std::uintmax_t byte : positions(file, 60)) {
      const FlippedBit damage(file, byte, bit());
      ++flipped;
      EXPECT_THROW(cupola::read_run(run_), Failure) << file << " byte " << byte;
      EXPECT_THROW(cupola::RunFolder::open(run_), Failure) << file << " byte " << byte;
    }
  }
  EXPECT_NO_THROW(cupola::RunFolder::open(run_));
  std::cout << flipped << " of " << flipped << " flipped bits found in the journal and the frozen files\n";
}

TEST_F(Damage, IsListedByALookAtEverything) {
  EXPECT_TRUE(cupola::check_run(run_).problems.empty());
  for (const char* name : {"journal.jsonl", "run.json", "resolved.yaml", "episodes/001/dem/attempt-1/result.hdf",
                           "episodes/002/tracer/attempt-1/foam/mesh.hdf"}) {
    const FlippedBit damage(run_ / name, fs::file_size(run_ / name) / 3, 2);
    const auto problems = cupola::check_run(run_).problems;
    EXPECT_THAT(problems, testing::Contains(HasSubstr(name)));
    EXPECT_THAT(cupola::still_whole(run_), HasSubstr("tracer stage of episode 1"));
  }
  fs::remove_all(run_ / "episodes/002/dem");
  EXPECT_THAT(cupola::check_run(run_).problems, testing::Contains(HasSubstr("missing")));
}

TEST_F(Damage, OfACheckpointOrItsSealMakesTheOlderOneCount) {
  const fs::path task = folder_.path() / "task";
  fs::create_directories(task);
  const fs::path content = run_ / "episodes/001/tracer/attempt-1/result.hdf";
  fs::copy_file(content, task / "checkpoint-A.h5");
  cupola::seal_checkpoint(task / "checkpoint-A.h5", 10);
  fs::copy_file(run_ / "episodes/002/tracer/attempt-1/result.hdf", task / "checkpoint-B.h5");
  cupola::seal_checkpoint(task / "checkpoint-B.h5", 20);
  const auto step_of_b = [&] { return cupola::find_checkpoints(task).at(1).step; };
  EXPECT_EQ(step_of_b(), 20);
  for (const char* name : {"checkpoint-B.h5", "checkpoint-B.hash"}) {
    for (const std::uintmax_t byte : positions(task / name, 60)) {
      const FlippedBit damage(task / name, byte, bit());
      EXPECT_FALSE(step_of_b()) << name << " byte " << byte;
      EXPECT_EQ(cupola::find_checkpoints(task).at(0).step, 10);
    }
  }
  fs::resize_file(task / "checkpoint-B.h5", fs::file_size(task / "checkpoint-B.h5") / 2);
  EXPECT_FALSE(step_of_b()) << "torn";
  fs::remove(task / "checkpoint-A.hash");
  EXPECT_FALSE(cupola::find_checkpoints(task).at(0).step) << "not sealed yet";
}

TEST_F(Damage, ATornLastLineOfTheJournalIsNone) {
  const fs::path file = run_ / "journal.jsonl";
  const std::string text = cupola::read_text(file);
  const std::size_t lines = cupola::read_journal(file).size();
  const std::size_t last = text.rfind('\n', text.size() - 2) + 1;
  for (std::size_t length = last + 1; length + 1 < text.size(); length += 7) {
    std::ofstream(file, std::ios::binary) << text.substr(0, length);
    EXPECT_EQ(cupola::read_journal(file).size(), lines - 1);
  }
  std::ofstream(file, std::ios::binary) << text.substr(0, last) << std::string(100, '\0');
  EXPECT_EQ(cupola::read_journal(file).size(), lines - 1) << "blocks a power cut left empty";
}

TEST_F(Damage, OfTheRunThatAStudyRefersToIsFoundBeforeAnythingRuns) {
  const fs::path study = folder_.path() / "study.yaml";
  cupola::write_text_atomically(
      study, "study: against-a-run\nscene: " + (run_ / "campaign.yaml").string() +
                 "\nstage: tracer\nvary:\n  - tracer.time_step: [10 s, 50 s]\nreference: {run: " + run_.string() +
                 "}\nmetrics: [temperature]\n");
  EXPECT_EQ(to_text(cupola::read_study(study).errors), "");
  fs::path result;
  for (const auto& entry : fs::recursive_directory_iterator(run_))
    if (entry.path().filename() == "result.hdf" && entry.path().string().find("/002/tracer/") != std::string::npos)
      result = entry.path();
  {
    const FlippedBit damage(result, fs::file_size(result) / 2, 3);
    EXPECT_THAT(to_text(cupola::read_study(study).errors), HasSubstr("result.hdf: other content"));
  }
  // As one that was stopped before its end: the journal without its last lines.
  std::string journal = cupola::read_text(run_ / "journal.jsonl");
  journal.resize(journal.rfind('\n', journal.find("\"event\":\"campaign-ended\"")) + 1);
  cupola::write_text_atomically(run_ / "journal.jsonl", journal);
  EXPECT_THAT(to_text(cupola::read_study(study).errors), HasSubstr("has not come to its end: resume it first"));
}

}  // namespace
