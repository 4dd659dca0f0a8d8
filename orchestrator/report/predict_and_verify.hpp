#pragma once
#include <nlohmann/json.hpp>

#include "orchestrator/run_folder.hpp"

namespace cupola {

/// `predict_and_verify` of the report: which hours were marched and which were not, what each step changed, and the
/// estimate of the remaining error; null for a campaign that marches.
/// @param report its `prediction` and `episodes` are read
nlohmann::json predict_and_verify(const RunRecord& run, const nlohmann::json& report);

}  // namespace cupola
