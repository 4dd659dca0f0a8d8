#pragma once
#include <filesystem>
#include <map>
#include <string>

#include "schemas/task.hpp"

namespace cupola {

/// The random seed of a stage: the same whenever the campaign is run, different for each stage of each episode.
std::uint64_t stage_seed(std::uint64_t campaign_seed, int episode, TaskKind kind);

/// What a stage is to do.
/// @param inputs by the names of `Task::inputs`; files, whose hashes are taken now
/// @param folder the task folder, for the relative paths
Task stage_task(TaskKind kind, int episode, const Campaign& campaign, const std::string& campaign_hash,
                const std::map<std::string, std::filesystem::path>& inputs, const std::filesystem::path& folder);

/// Makes the task folder with its `task.yaml`; where that is there already, checks that it says the same.
/// @param known_hash of the file, where the journal knows it: then it must be that to the last byte. Where it does not,
/// nothing has been done with the file yet and it is written anew.
/// @throws Failure wrong_input: the folder's task belongs to another campaign or has other inputs; input_output: it is
/// damaged
void ensure_task(const std::filesystem::path& folder, const Task& task, const std::string& known_hash = "");

}  // namespace cupola
