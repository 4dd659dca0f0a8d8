#include "orchestrator/report/prediction_report.hpp"

#include "orchestrator/prediction.hpp"
#include "orchestrator/report/json_numbers.hpp"

namespace cupola {

using nlohmann::json;

std::optional<StageReport> read_prediction_report(const RunRecord& run) {
  if (!has_prediction(run.folder)) {
    return std::nullopt;
  }
  StageReport stage;
  stage.episode = 0;
  stage.kind = TaskKind::tracer;
  stage.state.folder = prediction_folder(run.folder);
  stage.state.condition = StageState::Condition::finished;
  stage.summary = json::object();
  read_stage_result(stage, run);
  return stage;
}

json prediction_entry(const std::optional<StageReport>& prediction) {
  if (!prediction || !prediction->readable) {
    return nullptr;
  }
  const json& summary = prediction->summary;
  const json how = summary.value("prediction", json::object());
  return {{"mean_solid_temperature", number_or_null(summary, "/mean_solid_temperature")},
          {"cohesive_zone", summary.value("cohesive_zone", json())},
          {"softening_zone", summary.value("softening_zone", json())},
          {"top_gas_temperature", number_or_null(summary, "/top_gas_temperature")},
          {"expected_error", number_or_null(how, "/expected_error")},
          {"wall_seconds", number_or_null(summary, "/wall_seconds")},
          {"converged", how.value("converged", false)},
          {"warnings", how.value("warnings", json::array())},
          {"energy_residual", number_or_null(summary, "/ledger/energy/residual")},
          {"summary", summary}};
}

}  // namespace cupola
