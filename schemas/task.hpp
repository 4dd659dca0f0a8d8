#pragma once
#include <cstdint>
#include <filesystem>
#include <map>
#include <string>

#include "schemas/campaign.hpp"

namespace cupola {

enum class TaskKind { dem, tracer, predict, correct };

/// A file a task reads, with the content hash it must have.
struct TaskInput {
  std::filesystem::path file;  ///< relative to the task folder
  std::string hash;            ///< as hash_file gives it
};

/// `task.yaml`: all a stage needs to know.  Inputs by name:
///   dem:    `packing` (DEM result of the episode before; absent in the first), `solids_temperature` (tracer result of
///   the
///           episode before; absent in the first: the guessed cohesive zone of the campaign counts)
///   tracer: `granular` (DEM result of this episode), `solids_temperature` (what it softened by, or absent),
///   `prediction`
///           (whose temperatures the tracers begin with, and windows are kept for a correction; without: they begin
///           with `solids_temperature`)
///   predict: `granular` (the last DEM result), `solids_temperature` (what that one softened by, and the first guess),
///           `correction` (what marches have measured against predictions); or none of them
///   correct: `granular`, `solids_temperature` (as above), `prediction`, and `march` (tracer result that began with it)
struct Task {
  TaskKind kind = TaskKind::dem;
  int episode = 1;            ///< from 1
  std::string campaign_hash;  ///< of the frozen campaign file
  std::string program_version;
  std::uint64_t random_seed = 1;  ///< of this task
  std::map<std::string, TaskInput> inputs;
  Campaign campaign;  ///< resolved
};

/// The text of `task.yaml`.
std::string task_text(const Task& task);

/// Writes `task.yaml` atomically into the folder. @throws Failure input_output
void write_task(const std::filesystem::path& folder, const Task& task);

/// Reads `task.yaml` and checks that every input is there with its hash.
/// @throws Failure wrong_input (names the key), input_output
Task read_task(const std::filesystem::path& folder);

}  // namespace cupola
