#pragma once
#include <filesystem>
#include <optional>
#include <vector>

namespace cupola {

/// A checkpoint of a task folder and what its seal says.
struct CheckpointSeal {
  std::filesystem::path file;
  std::optional<long> step;  ///< none where the file is torn or damaged: its seal is missing or does not fit
};

/// `checkpoint-A.h5` and `checkpoint-B.h5`, those that are there.
std::vector<CheckpointSeal> find_checkpoints(const std::filesystem::path& task_folder);

/// Writes `checkpoint-X.hash` beside a checkpoint: content hash, step, and the hash of these two.
void seal_checkpoint(const std::filesystem::path& checkpoint, long step);

/// Copies the whole checkpoints with their seals into another task folder (a retry goes on from them).
/// @return whether there was one
bool copy_checkpoints(const std::filesystem::path& from, const std::filesystem::path& into);

}  // namespace cupola
