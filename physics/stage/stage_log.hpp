#pragma once
#include <filesystem>

namespace cupola {

/// Set in the environment of a stage whose standard error is appended to `stage.log` by who started it.
inline constexpr const char* stderr_goes_to_log = "CUPOLA_STDERR_IS_STAGE_LOG";

/// Makes spdlog's default logger write to `stage.log` of the task folder (rank 0, appending) and warnings to standard
/// error, unless that goes to the same file (`stderr_goes_to_log`). Other ranks log errors to standard error only.
void open_stage_log(const std::filesystem::path& task_folder, int rank);

}  // namespace cupola
