#pragma once
#include <nlohmann/json.hpp>
#include <string>

#include "orchestrator/run_folder.hpp"

namespace cupola {

/// How a run stands, from its files alone; nothing is changed.  Small files only: it can be asked over a slow disk.
/// @return `campaign, folder, state (running, queued, stopped, failed, or the verdict it ended with), held_by, message,
/// at_most, episode, stage, attempt, condition, job{number, state, reason}, progress{} (as in progress.json),
/// mean_solid_temperature, cohesive_zone_height (last known, K and m), remaining{episodes, seconds, until_limit, why},
/// warnings[] (the last ones), episodes[]{index, change{}, met}, records (of the journal)`; null where not known
nlohmann::json run_status(const RunRecord& run);

/// The same for a person, several lines.
std::string status_text(const nlohmann::json& status);

}  // namespace cupola
