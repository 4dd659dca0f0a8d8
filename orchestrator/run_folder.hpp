#pragma once
#include <filesystem>
#include <memory>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "orchestrator/built_with.hpp"
#include "orchestrator/journal.hpp"
#include "schemas/campaign.hpp"
#include "schemas/files.hpp"
#include "schemas/task.hpp"

namespace cupola {

/// What a run folder says, read without changing anything in it (docs/contracts.md).
struct RunRecord {
  std::filesystem::path folder;         ///< absolute
  nlohmann::json information;           ///< `run.json`
  Campaign campaign;                    ///< of `resolved.yaml`
  std::string campaign_hash;            ///< of `campaign.yaml`
  std::vector<nlohmann::json> journal;  ///< oldest first
};

/// @throws Failure wrong_input: not a run folder, or a frozen file was changed; input_output
RunRecord read_run(const std::filesystem::path& folder);

/// `RUN/episodes/002/dem`; `RUN/prediction` for what comes before all episodes
std::filesystem::path stage_folder(const std::filesystem::path& run, int episode, TaskKind kind);
/// `RUN/episodes/002/dem/attempt-1`; `RUN/prediction`
std::filesystem::path task_folder(const std::filesystem::path& run, int episode, TaskKind kind, int attempt);

/// A run folder this process works in: locked, its journal open.
class RunFolder {
 public:
  /// Makes the folder for a campaign file, or opens it where it is there and belongs to the same campaign.
  /// @param versions of program and libraries, noted down in a new folder
  /// @throws Failure wrong_input: the campaign is wrong, the folder belongs to another campaign (the keys are named) or
  /// holds something else; held: another orchestrator works there; input_output
  static std::unique_ptr<RunFolder> for_campaign(const std::filesystem::path& campaign_file,
                                                 const std::filesystem::path& folder,
                                                 const nlohmann::json& versions = program_versions());
  /// Opens a folder that is there. @throws Failure as above
  static std::unique_ptr<RunFolder> open(const std::filesystem::path& folder);

  [[nodiscard]] const std::filesystem::path& path() const { return path_; }
  [[nodiscard]] const Campaign& campaign() const { return campaign_; }
  [[nodiscard]] const std::string& campaign_hash() const { return campaign_hash_; }
  [[nodiscard]] const nlohmann::json& information() const { return information_; }  ///< `run.json`
  [[nodiscard]] Journal& journal() { return *journal_; }
  [[nodiscard]] const Journal& journal() const { return *journal_; }

 private:
  explicit RunFolder(const std::filesystem::path& folder);
  void load();

  std::filesystem::path path_;
  FolderLock lock_;
  nlohmann::json information_;
  Campaign campaign_;
  std::string campaign_hash_;
  std::unique_ptr<Journal> journal_;
};

}  // namespace cupola
