#include "orchestrator/convergence_rules.hpp"

#include <cmath>

namespace cupola {
namespace {

std::optional<std::vector<double>> two_before(const EpisodeWindow& window, std::vector<double> EpisodeFields::*field) {
  if (window.size() < 3) return std::nullopt;
  return window[window.size() - 3].*field;
}

const EpisodeFields& now(const EpisodeWindow& window) { return window.back(); }
const EpisodeFields& before(const EpisodeWindow& window) { return window[window.size() - 2]; }

Judgement temperature_rule(const EpisodeWindow& window, const Campaign& campaign) {
  std::vector<double> weights = moving_solids_volume(window);
  for (std::size_t cell = 0; cell < weights.size(); ++cell) weights[cell] *= now(window).heat_capacity[cell];
  return judge_temperature(now(window).temperature, before(window).temperature,
                           two_before(window, &EpisodeFields::temperature), weights, campaign.converged.temperature);
}

Judgement cohesive_zone_rule(const EpisodeWindow& window, const Campaign& campaign) {
  return judge_cohesive_zone(now(window).zone_height, before(window).zone_height,
                             two_before(window, &EpisodeFields::zone_height), now(window).zone_area,
                             campaign.scene.mesh.cell, campaign.converged.cohesive_zone_cells);
}

Judgement granular_velocity_rule(const EpisodeWindow& window, const Campaign& campaign) {
  const EpisodeFields &last = now(window), &previous = before(window);
  std::vector<double> difference(last.solids_velocity.size()), error(difference.size());
  for (std::size_t i = 0; i < difference.size(); ++i) {
    difference[i] = last.solids_velocity[i] - previous.solids_velocity.at(i);
    error[i] = std::hypot(last.velocity_error.at(i), previous.velocity_error.at(i));
  }
  const EpisodeWindow compared(window.end() - 2, window.end());
  return judge_granular_velocity(difference, error, moving_solids_volume(compared),
                                 campaign.converged.granular_velocity_sigma);
}

}  // namespace

const std::vector<ConvergenceRule>& convergence_rules() {
  static const std::vector<ConvergenceRule> rules = {
      {"temperature", [](const Campaign& campaign) { return campaign.heat.has_value(); }, temperature_rule},
      {"cohesive_zone", has_cohesive_zone, cohesive_zone_rule},
      {"granular_velocity", [](const Campaign&) { return true; }, granular_velocity_rule},
  };
  return rules;
}

double unmelted_share(const EpisodeFields& fields) {
  using nlohmann::json;
  const json& summary = fields.tracer_summary;
  const double charged = summary.value(json::json_pointer("/ledger/mass/in"), 0.);
  const double unmelted = summary.value(json::json_pointer("/ledger/mass/out/unmelted"), 0.);
  return charged > 0 ? unmelted / charged : 0.;
}

std::vector<double> moving_solids_volume(const EpisodeWindow& window) {
  std::vector<double> volume = window.back().cell_volume;
  for (std::size_t cell = 0; cell < volume.size(); ++cell) {
    volume[cell] *= window.back().solids_fraction[cell];
    for (const EpisodeFields& episode : window)
      if (episode.stagnant.at(cell) > 0.5) volume[cell] = 0;
  }
  return volume;
}

}  // namespace cupola
