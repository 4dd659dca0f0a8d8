#pragma once
#include <filesystem>
#include <functional>
#include <optional>
#include <vector>

namespace cupola {

/// Wall time between two checkpoints, s: `CUPOLA_CHECKPOINT_SECONDS` of the environment, else `usual`.
double checkpoint_interval(double usual);

/// The two checkpoints of a task folder, `checkpoint-A.h5` and `checkpoint-B.h5`, written in turns. `checkpoint-X.hash`
/// beside each (one line: content hash, step, and the hash of these two) is renamed into place after it, so that a
/// checkpoint without its right hash does not count: where the newer one is torn or damaged, the older one does.
class CheckpointFiles {
 public:
  explicit CheckpointFiles(std::filesystem::path task_folder) : folder_(std::move(task_folder)) {}

  struct Found {
    std::filesystem::path file;
    long step = 0;
  };
  /// The whole checkpoint of the latest step, or none. Others that are there and do not count are named in the log.
  [[nodiscard]] std::optional<Found> latest() const;

  /// Lets `write` make the file that is not the latest, then seals it.
  /// @param write gets the path of the file to make, atomically (HdfWriter)
  void write(long step, const std::function<void(const std::filesystem::path&)>& write) const;

 private:
  std::filesystem::path folder_;
};

}  // namespace cupola
