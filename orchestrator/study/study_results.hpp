#pragma once
#include <filesystem>
#include <nlohmann/json.hpp>

#include "orchestrator/study/study_tasks.hpp"

namespace cupola {

/// Everything a study has found so far: `study.json` (docs/studies.md), what the page shows.
nlohmann::json study_results(const Study& study, const StudyWork& work);

/// Writes `study.json` and `index.html` into the study's folder. @throws Failure input_output
void write_study_report(const std::filesystem::path& folder, const nlohmann::json& results);

}  // namespace cupola
