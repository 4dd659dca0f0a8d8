#pragma once
#include <filesystem>
#include <functional>

#include "schemas/failure.hpp"

namespace cupola {

/// Runs a stage (or a part of one) and turns what it throws into `failure.json` in the task folder, a line in the log
/// and the exit status of the program.  With several ranks the others are ended too (MPI_Abort), so that none waits for
/// ever; therefore what must outlive an abort, such as the FoamCase, is made outside:
///
///     return run_stage(folder, [&] {
///       FoamCase foam(folder / "foam", argc, argv);
///       return static_cast<ExitCode>(run_stage(folder, [&] { return march(foam); }));
///     });
///
/// A folder held by another process (ExitCode::held) is left untouched.
/// @return the status `stage` returned, or that of the failure
int run_stage(const std::filesystem::path& task_folder, const std::function<ExitCode()>& stage);

}  // namespace cupola
