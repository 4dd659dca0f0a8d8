#pragma once
#include <nlohmann/json.hpp>

#include "orchestrator/run_folder.hpp"
#include "orchestrator/stage_launcher.hpp"

namespace cupola {

/// Versions of the program and its libraries: what it was built with, and for the libraries of the stages what the
/// stages' programs find now.
/// @throws Failure input_output where a stage's program cannot be started or comes from another version of cupola
nlohmann::json present_versions(const StageLauncher& launcher);

/// Sees that a run goes on with the versions it goes by (those of its beginning, or those accepted last), and writes
/// accepted new ones into the journal.
/// @throws Failure wrong_input: names what differs, what of the run can still be used, and how to accept it
void settle_versions(RunFolder& run, const nlohmann::json& present, bool accept);

}  // namespace cupola
