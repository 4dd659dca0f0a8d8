#pragma once
#include <nlohmann/json.hpp>
#include <string>

#include "orchestrator/run_folder.hpp"

namespace cupola {

/// How a run stands, from its files alone; nothing is changed.
/// @return `campaign, folder, state (running, stopped, failed, or the verdict it ended with), held_by, message,
/// at_most, episode, stage, attempt, condition, progress{} (as in progress.json), episodes[]{index, change{}, met}`;
/// null where not known
nlohmann::json run_status(const RunRecord& run);

/// The same for a person, several lines.
std::string status_text(const nlohmann::json& status);

}  // namespace cupola
