#pragma once
#include <nlohmann/json.hpp>
#include <optional>

#include "orchestrator/report/stage_report.hpp"

namespace cupola {

/// The prediction of a run, as a tracer stage of episode 0; none where there is none that has ended.
std::optional<StageReport> read_prediction_report(const RunRecord& run);

/// `prediction` of report.json (docs/contracts.md): null without a readable prediction.
nlohmann::json prediction_entry(const std::optional<StageReport>& prediction);

}  // namespace cupola
