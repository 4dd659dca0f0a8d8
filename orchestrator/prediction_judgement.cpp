#include "orchestrator/prediction_judgement.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "orchestrator/convergence_rules.hpp"
#include "physics/closures/enthalpy_zero.hpp"
#include "schemas/field_file.hpp"

namespace cupola {
namespace {

using nlohmann::json;

json number(double value) { return std::isfinite(value) ? json(value) : json(nullptr); }

/// rms of the difference of two temperature fields over rms(T - 293 K).
double relative_difference(const std::vector<double>& now, const std::vector<double>& before,
                           const std::vector<double>& weights) {
  std::vector<double> difference = now, excess = now;
  for (std::size_t i = 0; i < now.size(); ++i) {
    difference[i] -= before.at(i);
    excess[i] -= enthalpy_zero;
  }
  const double level = weighted_rms(excess, weights);
  return level > 0 ? weighted_rms(difference, weights) / level : 0;
}

/// Shift of the zone, in cells; infinite where there is none.
double zone_shift(const FieldFile& now, const FieldFile& before, const Campaign& campaign) {
  const std::vector<double> area = now.hdf().doubles("CohesiveZone/area");
  const auto columns = static_cast<std::int64_t>(area.size());
  return judge_cohesive_zone(now.hdf().doubles("CohesiveZone/height_melted", columns),
                             before.hdf().doubles("CohesiveZone/height_melted", columns), std::nullopt, area,
                             campaign.scene.mesh.cell, 1)
      .figure;
}

}  // namespace

json judge_prediction(const std::vector<EpisodeFolders>& episodes, const std::filesystem::path& softened_by,
                      const Campaign& campaign) {
  constexpr double unknown = std::numeric_limits<double>::quiet_NaN();
  EpisodeWindow window;
  for (auto folders = episodes.end() - static_cast<long>(std::min<std::size_t>(episodes.size(), 2));
       folders != episodes.end(); ++folders)
    window.push_back(read_episode_fields(*folders, campaign));
  std::vector<double> weights = moving_solids_volume({window.back()});
  for (std::size_t cell = 0; cell < weights.size(); ++cell) weights[cell] *= window.back().heat_capacity[cell];

  const FieldFile corrected(episodes.back().correct.value() / "result.hdf", "tracer-result");
  const json measured = corrected.summary().at("correction");
  const double to_go = measured.at("to_go"), noise = measured.at("noise"), apart = measured.at("from_prediction");
  const double left_alone = std::sqrt(std::max(0., apart * apart - noise * noise));
  double jump = unknown, zone = unknown;
  if (!softened_by.empty()) {
    const FieldFile before(softened_by, "tracer-result", corrected.header().mesh_hash);
    jump =
        relative_difference(corrected.cell_data("solids_temperature"), before.cell_data("solids_temperature"), weights);
    if (has_cohesive_zone(campaign)) zone = remaining_error_safety * zone_shift(corrected, before, campaign);
  }
  const double estimate = remaining_error_safety * std::sqrt(jump * jump + to_go * to_go + noise * noise);

  json change = {{"temperature", number(estimate / campaign.converged.temperature)},
                 {"cohesive_zone", number(zone / campaign.converged.cohesive_zone_cells)},
                 {"granular_velocity", nullptr},
                 {"left_alone", number(left_alone / campaign.converged.temperature)}};
  json figure = {{"temperature", number(estimate)},
                 {"cohesive_zone", number(zone)},
                 {"granular_velocity", nullptr},
                 {"left_alone", number(left_alone)}};
  if (window.size() > 1) {
    for (const ConvergenceRule& rule : convergence_rules()) {
      if (rule.name != "granular_velocity") continue;
      const Judgement judgement = rule.judge(window, campaign);
      change[rule.name] = number(judgement.change);
      figure[rule.name] = number(judgement.figure);
    }
  }
  bool met = window.size() > 1;
  for (const auto& [rule, value] : change.items()) {
    if (rule == "cohesive_zone" && !has_cohesive_zone(campaign)) continue;
    met = met && value.is_number() && value.get<double>() < 1;
  }
  return {{"episode", episodes.size()},
          {"change", change},
          {"figure", figure},
          {"lambda", {{"temperature", nullptr}, {"cohesive_zone", nullptr}, {"granular_velocity", nullptr}}},
          {"met", met},
          {"unmelted_share", unmelted_share(window.back())},
          {"remaining_error",
           {{"estimate", number(estimate)},
            {"safety", remaining_error_safety},
            {"jump", number(jump)},
            {"to_go", to_go},
            {"noise", noise},
            {"left_alone", left_alone}}}};
}

bool is_verified(const json& judgement) { return judgement.contains("remaining_error"); }

}  // namespace cupola
