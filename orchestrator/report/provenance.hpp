#pragma once
#include <filesystem>
#include <nlohmann/json.hpp>
#include <vector>

#include "orchestrator/report/stage_report.hpp"

namespace cupola {

/// Where the numbers come from: everything that is needed to make them again and to know that nothing was changed.
/// @return `command` (to reproduce), `campaign_hash`, `resolved_hash`, `hosts[]`, `starts[]` (of the orchestrator:
/// host, time, program version), `stages[]` (`stage, episode, attempt, random_seed, ranks, program_version,
/// inputs{name: {file, hash}}, files{name: {size, hash}}`, paths relative to the run folder), `advice[]` (campaign keys
/// that retries changed)
nlohmann::json provenance(const RunRecord& run, const std::vector<StageReport>& stages);

/// `ro-crate-metadata.json`: the run folder described as a Research Object Crate (RO-Crate 1.1), so that repositories
/// can take it in.
/// @param report what make_report has gathered, `provenance` in it
nlohmann::json ro_crate(const RunRecord& run, const nlohmann::json& report);

}  // namespace cupola
