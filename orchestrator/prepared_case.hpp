#pragma once
#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "orchestrator/stage_state.hpp"

namespace cupola {

/// Hash over the names and contents of all files of a prepared OpenFOAM case but the logs of its tools, so that a case
/// damaged between its preparation and its use is found.
std::string case_fingerprint(const std::filesystem::path& foam_folder);

/// How the OpenFOAM case of an attempt stands against what the journal says of its preparation.
enum class CaseCondition { missing, damaged, ready };

/// @param task_folder holds `foam/`, @param ranks the case is wanted for
CaseCondition case_condition(const std::vector<nlohmann::json>& journal, int episode, TaskKind kind, int attempt,
                             const std::filesystem::path& task_folder, int ranks);

}  // namespace cupola
