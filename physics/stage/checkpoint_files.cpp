#include "physics/stage/checkpoint_files.hpp"

#include <fmt/format.h>
#include <spdlog/spdlog.h>

#include <cstdlib>

#include "schemas/checkpoint_seal.hpp"
#include "schemas/files.hpp"

namespace cupola {
namespace {

std::optional<CheckpointFiles::Found> latest_of(const std::vector<CheckpointSeal>& checkpoints) {
  std::optional<CheckpointFiles::Found> latest;
  for (const CheckpointSeal& checkpoint : checkpoints)
    if (checkpoint.step && (!latest || *checkpoint.step > latest->step)) latest = {checkpoint.file, *checkpoint.step};
  return latest;
}

}  // namespace

double checkpoint_interval(double usual) {
  const char* wanted = std::getenv("CUPOLA_CHECKPOINT_SECONDS");
  return wanted != nullptr ? std::atof(wanted) : usual;
}

std::optional<CheckpointFiles::Found> CheckpointFiles::latest() const {
  const auto checkpoints = find_checkpoints(folder_);
  const auto found = latest_of(checkpoints);
  for (const CheckpointSeal& checkpoint : checkpoints)
    if (!checkpoint.step)
      spdlog::warn("{} is torn or damaged and does not count; {}", checkpoint.file.string(),
                   found ? fmt::format("going on from that of step {}", found->step) : "beginning again");
  return found;
}

void CheckpointFiles::write(long step, const std::function<void(const std::filesystem::path&)>& write) const {
  const auto kept = latest_of(find_checkpoints(folder_));
  const bool a_is_kept = kept && kept->file.filename() == "checkpoint-A.h5";
  const std::filesystem::path file = folder_ / (a_is_kept ? "checkpoint-B.h5" : "checkpoint-A.h5");
  write(file);
  sync_history(folder_);  // the checkpoint counts on its lines
  seal_checkpoint(file, step);
}

}  // namespace cupola
