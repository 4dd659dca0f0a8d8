#pragma once
#include <filesystem>

namespace cupola {

/// Makes spdlog's default logger write to `stage.log` of the task folder (rank 0, appending) and warnings to standard
/// error. Other ranks log errors to standard error only.
void open_stage_log(const std::filesystem::path& task_folder, int rank);

}  // namespace cupola
