#pragma once
#include <filesystem>
#include <string>
#include <vector>

namespace cupola {

/// What a look at every byte of a run folder has found.
struct RunCheck {
  std::size_t files = 0;              ///< whose hashes were compared
  std::vector<std::string> whole;     ///< finished stages that can be used: `dem stage of episode 1`
  std::vector<std::string> problems;  ///< sentences: what is damaged, changed, swapped or missing
  std::vector<std::string> remarks;   ///< what is no damage: a torn checkpoint beside a whole one, a line cut short
};

/// Compares everything in a run folder that carries a hash: run.json, the frozen campaign, the journal's chain,
/// manifests against the journal, every file against its manifest, tasks, OpenFOAM cases and checkpoints of stages
/// under way. Nothing is changed. Logs, progress and report are not looked at: they are not read again.
/// @throws Failure wrong_input where the folder is no run
RunCheck check_run(const std::filesystem::path& run);

/// One sentence: which results of a run are whole and can still be used. Never fails.
std::string still_whole(const std::filesystem::path& run);
/// The same after a sentence about what is not.
std::string still_whole(const std::filesystem::path& run, const std::string& sentence);

}  // namespace cupola
