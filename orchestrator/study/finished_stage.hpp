#pragma once
#include <filesystem>
#include <optional>

#include "schemas/task.hpp"

namespace cupola {

/// The task folder of the last stage of this kind that has finished in a run folder; none where none has.
/// @throws Failure wrong_input: not a run folder; input_output
std::optional<std::filesystem::path> last_finished_stage(const std::filesystem::path& run_folder, TaskKind kind);

/// Has the campaign of a run folder come to its end (converged, or at its limit) and not gone on since?
/// @throws Failure wrong_input: not a run folder; input_output
bool has_ended(const std::filesystem::path& run_folder);

}  // namespace cupola
