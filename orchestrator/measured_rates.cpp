#include "orchestrator/measured_rates.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cstdlib>

#include "orchestrator/child_process.hpp"
#include "orchestrator/journal.hpp"
#include "schemas/failure.hpp"
#include "schemas/files.hpp"

namespace cupola {
namespace {

using nlohmann::json;
namespace fs = std::filesystem;

constexpr std::size_t stages_kept = 40;

struct Part {
  const char* name;
  double Rates::*rate;
};
constexpr std::array<Part, 8> parts = {{{"contacts", &Rates::contacts},
                                        {"dem_gas", &Rates::dem_gas},
                                        {"motion", &Rates::motion},
                                        {"exchange", &Rates::exchange},
                                        {"conduction", &Rates::conduction},
                                        {"gas_flow", &Rates::gas_flow},
                                        {"gas_flow_navier_stokes", &Rates::gas_flow_navier_stokes},
                                        {"gas_energy", &Rates::gas_energy}}};

json read_or_empty(const fs::path& file) {
  try {
    json known = fs::exists(file) ? read_json(file) : json::object();
    return known.is_object() && known.value("schema", 0) == 1 ? known : json{{"schema", 1}, {"hosts", json::object()}};
  } catch (const Failure&) {
    return {{"schema", 1}, {"hosts", json::object()}};
  }
}

/// How much was done, and the core seconds it took.
json work(double units, double wall, double ranks) { return {{"units", units}, {"core_seconds", wall * ranks}}; }

/// Half of the work was done faster, half slower: a stage on a machine that was busy with something else, or one too
/// small to show more than its overheads, does not count for much.
/// @param measured values with their weights, at least one
double weighted_median(std::vector<std::pair<double, double>> measured) {
  std::sort(measured.begin(), measured.end());
  double total = 0, below = 0;
  for (const auto& [value, weight] : measured) total += weight;
  for (std::size_t i = 0; i < measured.size(); ++i) {
    below += measured[i].second;
    if (i + 1 < measured.size() && below == total / 2) return (measured[i].first + measured[i + 1].first) / 2;
    if (below >= total / 2) return measured[i].first;
  }
  return measured.back().first;
}

double wall_of(const json& stage, std::initializer_list<const char*> names) {
  double sum = 0;
  for (const char* name : names) sum += stage.at("wall_seconds_by_part").value(name, 0.);
  return sum;
}

json work_of_dem(const json& stage) {
  const auto ranks = stage.at("ranks").get<double>(), cells = stage.at("cells").get<double>();
  const double steps = stage.at("process_seconds").get<double>() / stage.at("time_step").get<double>();
  return {{"contacts", work(stage.at("parcels").get<double>() * steps, wall_of(stage, {"liggghts"}), ranks)},
          {"dem_gas",
           work(cells * stage.value(json::json_pointer("/gas/flow_solves"), 0.), wall_of(stage, {"gas"}), ranks)}};
}

json work_of_tracer(const json& stage) {
  const auto ranks = stage.at("ranks").get<double>(), cells = stage.at("cells").get<double>();
  const auto steps = stage.at("steps").get<double>();
  return {{"motion", work(stage.at("tracers").get<double>() * steps, wall_of(stage, {"motion", "averages"}), ranks)},
          {"exchange",
           work(cells * steps, wall_of(stage, {"exchange", "exchange on cells", "projection", "balances"}), ranks)},
          {"conduction", work(cells * steps, wall_of(stage, {"conduction"}), ranks)},
          // In flow solutions a step, since the estimate does not know how many are skipped.
          {stage.value("gas_model", "") == "navier-stokes" ? "gas_flow_navier_stokes" : "gas_flow",
           work(cells * steps, wall_of(stage, {"flow"}), ranks)},
          {"gas_energy", work(cells * stage.value("energy_solves", 0.), wall_of(stage, {"gas energy"}), ranks)}};
}

}  // namespace

std::optional<fs::path> rates_file() {
  if (const char* named = std::getenv("CUPOLA_RATES")) {
    if (*named == '\0') return std::nullopt;
    return fs::path(named);
  }
  if (const char* cache = std::getenv("XDG_CACHE_HOME"); cache != nullptr && *cache != '\0')
    return fs::path(cache) / "cupola" / "rates.json";
  if (const char* home = std::getenv("HOME"); home != nullptr && *home != '\0')
    return fs::path(home) / ".cache" / "cupola" / "rates.json";
  return std::nullopt;
}

Rates measured_rates(const std::optional<fs::path>& file) {
  Rates rates;
  if (!file) return rates;
  const json known = read_or_empty(*file);
  const json stages = known["hosts"].value(host_name(), json::array());
  std::string latest;
  for (const Part& part : parts) {
    std::vector<std::pair<double, double>> measured;  // seconds a unit, units
    for (const json& stage : stages) {
      const json& done = stage.at("work");
      if (!done.contains(part.name)) continue;
      const double units = done[part.name].value("units", 0.), seconds = done[part.name].value("core_seconds", 0.);
      if (units > 0 && seconds > 0) measured.emplace_back(seconds / units, units);
    }
    if (!measured.empty()) rates.*part.rate = weighted_median(std::move(measured));
  }
  for (const json& stage : stages) latest = std::max(latest, stage.value("written", ""));
  if (!stages.empty())
    rates.basis =
        fmt::format("measured on {} in {} stages, the last on {}", host_name(), stages.size(), latest.substr(0, 10));
  return rates;
}

void remember_rates(const json& report, const std::optional<fs::path>& file) {
  if (!file) return;
  json known = read_or_empty(*file);
  json& stages = known["hosts"][host_name()];
  if (!stages.is_array()) stages = json::array();
  bool changed = false;
  for (const json& episode : report.at("episodes"))
    for (const char* kind : {"dem", "tracer"}) {
      const json& stage = episode.at(kind);
      if (!stage.is_object() || stage.value("state", "") != "finished" || !stage.contains("wall_seconds_by_part"))
        continue;
      const std::string key = fmt::format("{} {} {} {}", report.at("campaign_hash").get<std::string>(),
                                          report.value("started", ""), episode.at("index").get<int>(), kind);
      bool told = false;
      for (const json& one : stages) told = told || one.value("stage", "") == key;
      if (told) continue;
      const bool dem = std::string(kind) == "dem";
      stages.push_back(
          {{"stage", key}, {"written", utc_now()}, {"work", dem ? work_of_dem(stage) : work_of_tracer(stage)}});
      changed = true;
    }
  while (stages.size() > stages_kept) stages.erase(stages.begin());
  if (!changed) return;
  try {
    std::error_code error;
    fs::create_directories(file->parent_path(), error);
    write_json_atomically(*file, known);
  } catch (const Failure&) {
    return;
  }
}

}  // namespace cupola
