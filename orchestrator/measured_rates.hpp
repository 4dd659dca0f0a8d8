#pragma once
#include <filesystem>
#include <nlohmann/json.hpp>
#include <optional>

#include "physics/plan/rates.hpp"

namespace cupola {

/// Where the rates of this machine are kept: the file named by CUPOLA_RATES, else `cupola/rates.json` in
/// XDG_CACHE_HOME or `~/.cache`; none where none of these is set, or where CUPOLA_RATES is empty.
std::optional<std::filesystem::path> rates_file();

/// The rates of the stages that this host has run last; the built-in ones where there are none.
/// @param file none: the built-in ones
Rates measured_rates(const std::optional<std::filesystem::path>& file = rates_file());

/// Notes down what the finished stages of a report cost.  A stage counts once, however often it is told; the last forty
/// of a host are kept.  What cannot be written is left out: it is an estimate that gets no better.
/// @param report as make_report returns it
void remember_rates(const nlohmann::json& report, const std::optional<std::filesystem::path>& file = rates_file());

}  // namespace cupola
