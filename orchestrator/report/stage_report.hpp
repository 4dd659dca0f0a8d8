#pragma once
#include <filesystem>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

#include "orchestrator/run_folder.hpp"
#include "orchestrator/stage_sequence.hpp"
#include "orchestrator/stage_state.hpp"

namespace cupola {

/// A stage of an episode as the report sees it.
struct StageReport {
  int episode = 1;
  TaskKind kind = TaskKind::dem;
  StageState state;
  bool readable = false;   ///< finished, and its result is one of this campaign's
  std::string sentence;    ///< why it failed or cannot be read; else empty
  std::string mesh_hash;   ///< of a readable result
  nlohmann::json summary;  ///< `/Summary` of a readable result; of a stage under way what its progress says
  std::vector<nlohmann::json> history;

  [[nodiscard]] std::filesystem::path result() const { return state.folder / "result.hdf"; }
  /// `absent`, `interrupted`, `running`, `failed`, `finished` or `damaged`.
  [[nodiscard]] std::string state_text() const;
};

/// `DEM` or `tracer`, for people.
std::string shown_name(TaskKind kind);

/// Reads the result in the stage's folder: `summary`, or a `sentence` why not.
void read_stage_result(StageReport& stage, const RunRecord& run);

StageReport read_stage_report(const RunRecord& run, int episode, TaskKind kind);

/// All stages that were begun, in the order of the march.
std::vector<StageReport> read_stage_reports(const RunRecord& run);

}  // namespace cupola
