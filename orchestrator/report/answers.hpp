#pragma once
#include <nlohmann/json.hpp>
#include <string>

namespace cupola {

/// The report's first block: what a furnace engineer asks first, answered in words.
/// @param report what make_report has gathered: `state`, `episodes`, `criteria`, `furnace`, `ledger`, `wall_seconds`
/// @return `converged`, `state_of_the_bed`, `certainty`, `wall_time`: each {question, answer, detail}
nlohmann::json answers(const nlohmann::json& report);

/// Seconds as a person says them: `45 s`, `8 min 12 s`, `18 h 20 min`, `8.2 days`.
std::string duration_in_words(double seconds);

}  // namespace cupola
