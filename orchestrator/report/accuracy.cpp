#include "orchestrator/report/accuracy.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <cmath>

#include "orchestrator/convergence.hpp"
#include "orchestrator/report/answers.hpp"
#include "orchestrator/report/json_numbers.hpp"

namespace cupola {
namespace {

using nlohmann::json;

constexpr double an_hour = 3600;

/// Lines of a history that have the number, with the wall time of the campaign up to them.
json curve(const StageReport& stage, double wall_before, const std::string& pointer) {
  json entry = {{"episode", stage.episode}, {"wall_seconds", json::array()}, {"error", json::array()}};
  for (const json& line : stage.history) {
    const auto error = number_at(line, pointer), wall = number_at(line, "/wall_seconds");
    if (!error || !wall) continue;
    entry["wall_seconds"].push_back(rounded(wall_before + *wall));
    entry["error"].push_back(rounded(std::abs(*error)));
    if (const auto window = number_at(line, "/window_seconds")) entry["window_seconds"].push_back(rounded(*window));
  }
  return entry;
}

/// Wall time that the averaging window took.
double window_wall(const StageReport& stage) {
  std::optional<double> first, last;
  for (const json& line : stage.history) {
    if (line.value("phase", "") != "averaging") continue;
    const auto wall = number_at(line, "/wall_seconds");
    if (!first) first = wall;
    last = wall;
  }
  return first && last ? *last - *first : 0;
}

std::optional<double> last_value(const json& curve) {
  if (curve["error"].empty() || !curve["error"].back().is_number()) return std::nullopt;
  return curve["error"].back().get<double>();
}

double stage_wall(const StageReport& stage) { return number_at(stage.summary, "/wall_seconds").value_or(0); }

/// What the alternation still has to change, if the episodes say how it shrinks.
/// @param floor the granular velocity's standard error, below which no episode repeats the one before
void add_alternation(const json& report, double wall_of_episode, double floor, std::vector<ErrorSource>& sources) {
  if (report.at("episodes").empty()) return;
  const json& last = report.at("episodes").back();
  const auto figure = number_at(last, "/figures/temperature"), lambda = number_at(last, "/lambda/temperature");
  if (!figure || !lambda || wall_of_episode <= 0) return;
  sources.push_back({"the change from episode to episode",
                     "more episodes: `converged.at_most`, `cupola resume --at-most`", *figure, wall_of_episode,
                     ErrorSource::Law::contraction, std::clamp(std::abs(*lambda), smallest_lambda, largest_lambda),
                     floor});
}

}  // namespace

double ErrorSource::after(double seconds) const {
  switch (law) {
    case Law::statistics:
      return error * std::sqrt(wall / (wall + seconds));
    case Law::first_order:
      return error * wall / (wall + seconds);
    case Law::contraction:
      return std::max(error * std::pow(factor, seconds / wall), std::min(error, floor));
  }
  return error;
}

std::string where_the_next_hour_helps(const std::vector<ErrorSource>& sources) {
  if (sources.empty()) return "";
  const auto gain = [](const ErrorSource& source) { return source.error - source.after(an_hour); };
  const auto best = std::max_element(sources.begin(), sources.end(),
                                     [&](const auto& one, const auto& other) { return gain(one) < gain(other); });
  std::string text = fmt::format("The next hour would help most in {}: {} now, about {} after it ({}).", best->name,
                                 percent(best->error), percent(best->after(an_hour)), best->cure);
  for (const ErrorSource& source : sources)
    if (&source != &*best)
      text += fmt::format(" {}{} would go from {} to {}.", static_cast<char>(std::toupper(source.name.front())),
                          source.name.substr(1), percent(source.error), percent(source.after(an_hour)));
  return text;
}

json accuracy_and_cost(const std::vector<StageReport>& stages, const json& report) {
  json result = {{"granular", json::array()},
                 {"time_step", json::array()},
                 {"gas", json::array()},
                 {"episodes", json::array()},
                 {"sources", json::array()}};
  double wall = 0, wall_of_episode = 0;
  std::vector<ErrorSource> sources;
  std::optional<ErrorSource> granular, time_step;
  for (const StageReport& stage : stages) {
    if (stage.kind == TaskKind::dem) {
      const json errors = curve(stage, wall, "/velocity_error");
      if (const auto error = last_value(errors); error && window_wall(stage) > 0)
        granular = ErrorSource{"the granular velocity's statistics",
                               "a longer `dem.window`",
                               *error,
                               window_wall(stage),
                               ErrorSource::Law::statistics,
                               1};
      if (!errors["error"].empty()) result["granular"].push_back(errors);
      wall_of_episode = 0;
    } else if (stage.kind == TaskKind::tracer) {
      const json steps = curve(stage, wall, "/time_step_error"), gas = curve(stage, wall, "/gas_energy_residual");
      if (const auto error = last_value(steps); error && stage_wall(stage) > 0)
        time_step = ErrorSource{"the tracers' time step",
                                "a shorter `tracer.time_step`, or a smaller `tracer.accuracy`",
                                *error,
                                stage_wall(stage),
                                ErrorSource::Law::first_order,
                                1};
      if (!steps["error"].empty()) result["time_step"].push_back(steps);
      if (!gas["error"].empty()) result["gas"].push_back(gas);
    }
    wall += stage_wall(stage);
    wall_of_episode += stage_wall(stage);
    if (stage.kind != TaskKind::tracer) continue;
    for (const json& episode : report.at("episodes"))
      if (episode.at("index") == stage.episode)
        result["episodes"].push_back({{"episode", stage.episode},
                                      {"wall_seconds", wall},
                                      {"temperature", number_or_null(episode, "/figures/temperature")},
                                      {"cohesive_zone", number_or_null(episode, "/figures/cohesive_zone")},
                                      {"granular_velocity", number_or_null(episode, "/figures/granular_velocity")}});
  }
  if (granular) sources.push_back(*granular);
  if (time_step) sources.push_back(*time_step);
  add_alternation(report, wall_of_episode, granular ? granular->error : 0, sources);
  for (const ErrorSource& source : sources)
    result["sources"].push_back({{"name", source.name},
                                 {"cure", source.cure},
                                 {"error", source.error},
                                 {"wall_seconds", source.wall},
                                 {"after_an_hour", source.after(an_hour)}});
  result["where_an_hour_helps"] = where_the_next_hour_helps(sources);
  return result;
}

}  // namespace cupola
