#pragma once
#include <filesystem>
#include <nlohmann/json.hpp>

namespace cupola {

/// Everything the report says, at whatever point the run stands; reads only.  A stage whose result cannot be read is
/// reported as such.
/// @return what stands in report.json; its keys are listed in docs/contracts.md
/// @throws Failure wrong_input: not a run folder
nlohmann::json gather_report(const std::filesystem::path& run_folder);

/// Makes the report of a run, at whatever point it stands: `report/report.json` with every number,
/// `report/index.html`, one file that needs no network, `ro-crate-metadata.json`, and the views of `fields/`.
/// @return what stands in report.json
/// @throws Failure wrong_input: not a run folder; input_output: the report cannot be written
nlohmann::json make_report(const std::filesystem::path& run_folder);

}  // namespace cupola
