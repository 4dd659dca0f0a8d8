#include "orchestrator/remaining_time.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "orchestrator/convergence.hpp"

namespace cupola {
namespace {

using nlohmann::json;

constexpr int episodes_to_extrapolate = 3;  // an extrapolation needs two changes

std::optional<double> number(const json& record, const char* group, const std::string& rule) {
  if (!record.contains(group) || !record[group].contains(rule) || !record[group][rule].is_number()) return std::nullopt;
  return record[group][rule].get<double>();
}

/// How much a rule's change shrinks an episode; none: it does not, or is not known.
std::optional<double> contraction(const std::vector<json>& judged, const std::string& rule) {
  std::optional<double> factor = number(judged.back(), "lambda", rule);
  if (!factor) {
    const auto before = number(judged[judged.size() - 2], "change", rule), now = number(judged.back(), "change", rule);
    if (before && now && *before > 0) factor = *now / *before;
  }
  if (!factor || !(std::abs(*factor) <= largest_lambda)) return std::nullopt;
  return std::max(std::abs(*factor), smallest_lambda);
}

}  // namespace

std::optional<RemainingEpisodes> remaining_episodes(const std::vector<json>& judged, const Converged& converged,
                                                    int at_most) {
  if (judged.size() < 2) return std::nullopt;
  const int done = static_cast<int>(judged.size());
  const int left = std::max(at_most - done, 0);
  const json changes = judged.back().value("change", json::object());
  int longest = 0;
  std::string why = "all rules are met";
  for (const auto& [rule, change] : changes.items()) {
    if (change.is_number() && change.get<double>() < 1) continue;
    const auto factor = contraction(judged, rule);
    if (!change.is_number() || !factor)
      return RemainingEpisodes{left, true, fmt::format("{} shows no trend yet", rule)};
    const int needed = static_cast<int>(std::ceil(std::log(change.get<double>()) / -std::log(*factor)));
    if (std::max(needed, 1) <= longest) continue;
    longest = std::max(needed, 1);
    why = fmt::format("{} takes longest", rule);
  }
  int met = 0;
  for (auto record = judged.rbegin(); record != judged.rend() && record->value("met", false); ++record) ++met;
  int episodes = longest > 0 ? longest + converged.for_episodes - 1 : converged.for_episodes - met;
  episodes = std::max({episodes, episodes_to_extrapolate - done, 0});
  if (episodes > left) return RemainingEpisodes{left, true, why};
  return RemainingEpisodes{episodes, false, why};
}

}  // namespace cupola
