#include "orchestrator/stage_task.hpp"

#include <fmt/format.h>

#include <charconv>

#include "orchestrator/stage_launcher.hpp"
#include "schemas/failure.hpp"
#include "schemas/files.hpp"
#include "schemas/version.hpp"

namespace cupola {
namespace {

void require(bool same, const std::filesystem::path& folder, const std::string& key) {
  if (same) return;
  throw Failure(ExitCode::wrong_input,
                fmt::format("{}: {} is not that of this run: the folder comes from another campaign or was changed. "
                            "Nothing was changed. Move it away and resume.",
                            (folder / "task.yaml").string(), key))
      .at("key", key);
}

void require_same(const std::filesystem::path& folder, const Task& there, const Task& here) {
  require(there.campaign_hash == here.campaign_hash, folder, "campaign_hash");
  require(there.kind == here.kind, folder, "kind");
  require(there.episode == here.episode, folder, "episode");
  require(there.random_seed == here.random_seed, folder, "random_seed");
  require(there.inputs.size() == here.inputs.size(), folder, "inputs");
  for (const auto& [name, input] : here.inputs) {
    const auto found = there.inputs.find(name);
    require(found != there.inputs.end() && found->second.hash == input.hash, folder, "inputs." + name);
  }
}

}  // namespace

std::uint64_t stage_seed(std::uint64_t campaign_seed, int episode, TaskKind kind) {
  const std::string hash = hash_text(fmt::format("{}/{}/{}", campaign_seed, episode, stage_name(kind)));
  // 53 bits: exact in YAML and JSON readers that hold numbers as doubles.
  const std::string digits = hash.substr(hash.find(':') + 1, 13);
  std::uint64_t seed = 0;
  std::from_chars(digits.data(), digits.data() + digits.size(), seed, 16);
  return seed;
}

Task stage_task(TaskKind kind, int episode, const Campaign& campaign, const std::string& campaign_hash,
                const std::map<std::string, std::filesystem::path>& inputs, const std::filesystem::path& folder) {
  Task task;
  task.kind = kind;
  task.episode = episode;
  task.campaign_hash = campaign_hash;
  task.program_version = program_version;
  task.random_seed = stage_seed(campaign.random_seed, episode, kind);
  for (const auto& [name, file] : inputs) task.inputs[name] = {file.lexically_relative(folder), hash_file(file)};
  task.campaign = campaign;
  return task;
}

void ensure_task(const std::filesystem::path& folder, const Task& task, const std::string& known_hash) {
  std::error_code error;
  std::filesystem::create_directories(folder, error);
  if (error)
    throw Failure(ExitCode::input_output, fmt::format("{}: cannot be made: {}.", folder.string(), error.message()));
  const std::filesystem::path file = folder / "task.yaml";
  if (!known_hash.empty() && (!std::filesystem::exists(file) || hash_file(file) != known_hash))
    throw Failure(
        ExitCode::input_output,
        fmt::format("{}: not the task that was written: it was damaged, changed or removed. Put it back from a "
                    "copy, or move {} away and resume: the stage then begins again.",
                    file.string(), folder.string()))
        .at("file", file.string());
  if (std::filesystem::exists(file)) require_same(folder, read_task(folder), task);
  if (known_hash.empty()) write_task(folder, task);
}

}  // namespace cupola
