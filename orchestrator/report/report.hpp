#pragma once
#include <filesystem>
#include <nlohmann/json.hpp>

namespace cupola {

/// Makes the report of a run, at whatever point it stands: `report/report.json` with every number, and
/// `report/index.html`, one file that needs no network.  Reads only; a stage whose result cannot be read is reported as
/// such.
/// @return what stands in report.json; its keys are listed in docs/contracts.md
/// @throws Failure wrong_input: not a run folder; input_output: the report cannot be written
nlohmann::json make_report(const std::filesystem::path& run_folder);

}  // namespace cupola
