#include "physics/stage/checkpoint_files.hpp"

#include <fmt/format.h>

#include <sstream>

#include "schemas/files.hpp"

namespace cupola {
namespace {

std::filesystem::path seal_of(std::filesystem::path checkpoint) { return checkpoint.replace_extension(".hash"); }

std::optional<CheckpointFiles::Found> whole(const std::filesystem::path& file) {
  if (!std::filesystem::exists(file) || !std::filesystem::exists(seal_of(file))) return std::nullopt;
  std::istringstream seal(read_text(seal_of(file)));
  std::string hash;
  CheckpointFiles::Found found{file, 0};
  if (!(seal >> hash >> found.step) || hash != hash_file(file)) return std::nullopt;
  return found;
}

}  // namespace

std::optional<CheckpointFiles::Found> CheckpointFiles::latest() const {
  const auto a = whole(folder_ / "checkpoint-A.h5");
  const auto b = whole(folder_ / "checkpoint-B.h5");
  if (a && b) return a->step > b->step ? a : b;
  return a ? a : b;
}

void CheckpointFiles::write(long step, const std::function<void(const std::filesystem::path&)>& write) const {
  const auto kept = latest();
  const bool a_is_kept = kept && kept->file.filename() == "checkpoint-A.h5";
  const std::filesystem::path file = folder_ / (a_is_kept ? "checkpoint-B.h5" : "checkpoint-A.h5");
  write(file);
  write_text_atomically(seal_of(file), fmt::format("{} {}\n", hash_file(file), step));
}

}  // namespace cupola
