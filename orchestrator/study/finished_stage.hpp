#pragma once
#include <filesystem>
#include <optional>

#include "schemas/task.hpp"

namespace cupola {

/// The task folder of the last stage of this kind that has finished in a run folder; none where none has.
/// @throws Failure wrong_input: not a run folder; input_output
std::optional<std::filesystem::path> last_finished_stage(const std::filesystem::path& run_folder, TaskKind kind);

}  // namespace cupola
