#pragma once
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

/// Numbers of report.json.
namespace cupola {

/// The number with `digits` significant digits, which keeps a file of many numbers small; null for NaN and infinity.
nlohmann::json rounded(double value, int digits = 6);
nlohmann::json rounded(const std::vector<double>& values, int digits = 6);

/// `0.034` is `3.4 %`.
std::string percent(double share);

/// The finite number at a JSON pointer (`/ledger/mass/in`); none where there is nothing or something else.
std::optional<double> number_at(const nlohmann::json& value, const std::string& pointer);
/// The same as JSON: null where there is none.
nlohmann::json number_or_null(const nlohmann::json& value, const std::string& pointer);

}  // namespace cupola
