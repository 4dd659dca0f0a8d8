#pragma once
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

namespace cupola {

/// What a reader must know before using the results: unmelted ore, limits of the model that were met, starved raceways,
/// ledgers that do not close, stages that were tried again.
/// @param report what make_report has gathered: `episodes`, `results`, `retries`
std::vector<std::string> warnings(const nlohmann::json& report);

}  // namespace cupola
