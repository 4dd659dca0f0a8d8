#pragma once
#include <filesystem>
#include <string>
#include <vector>

namespace cupola {

/// Runs one of OpenFOAM's own programs (blockMesh, checkMesh, decomposePar) on a case as a child process.
/// What it prints goes to `log.<program>` in the case.
/// @return what it printed
/// @throws Failure input_output where it is not installed or ends with an error (quotes the last lines of the log)
std::string run_foam_tool(const std::string& program, const std::vector<std::string>& options,
                          const std::filesystem::path& case_folder);

}  // namespace cupola
