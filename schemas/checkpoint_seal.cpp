#include "schemas/checkpoint_seal.hpp"

#include <fmt/format.h>

#include <charconv>

#include "schemas/files.hpp"

namespace cupola {
namespace {

std::filesystem::path seal_of(std::filesystem::path checkpoint) { return checkpoint.replace_extension(".hash"); }

std::string seal_text(const std::string& content_hash, long step) {
  const std::string said = fmt::format("{} {}", content_hash, step);
  return fmt::format("{} {}\n", said, hash_text(said));
}

/// The step a seal speaks of; none where it is not a seal of this file, to the last byte.
std::optional<long> sealed_step(const std::filesystem::path& file) {
  if (!std::filesystem::exists(seal_of(file))) return std::nullopt;
  const std::string text = read_text(seal_of(file));
  const std::size_t begin = text.find(' ');
  if (begin == std::string::npos) return std::nullopt;
  long step = 0;
  std::from_chars(text.data() + begin + 1, text.data() + text.size(), step);
  if (text != seal_text(hash_file(file), step)) return std::nullopt;
  return step;
}

void copy_atomically(const std::filesystem::path& from, const std::filesystem::path& to) {
  std::filesystem::copy_file(from, temporary_beside(to), std::filesystem::copy_options::overwrite_existing);
  publish(temporary_beside(to), to);
}

}  // namespace

std::vector<CheckpointSeal> find_checkpoints(const std::filesystem::path& task_folder) {
  std::vector<CheckpointSeal> found;
  for (const char* name : {"checkpoint-A.h5", "checkpoint-B.h5"})
    if (std::filesystem::exists(task_folder / name))
      found.push_back({task_folder / name, sealed_step(task_folder / name)});
  return found;
}

void seal_checkpoint(const std::filesystem::path& checkpoint, long step) {
  write_text_atomically(seal_of(checkpoint), seal_text(hash_file(checkpoint), step));
}

bool copy_checkpoints(const std::filesystem::path& from, const std::filesystem::path& into) {
  bool any = false;
  for (const CheckpointSeal& checkpoint : find_checkpoints(from)) {
    if (!checkpoint.step) continue;
    copy_atomically(checkpoint.file, into / checkpoint.file.filename());
    copy_atomically(seal_of(checkpoint.file), into / seal_of(checkpoint.file).filename());
    any = true;
  }
  return any;
}

}  // namespace cupola
