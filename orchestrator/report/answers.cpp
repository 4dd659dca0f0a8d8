#include "orchestrator/report/answers.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "orchestrator/quantity_text.hpp"
#include "orchestrator/report/json_numbers.hpp"

namespace cupola {

using nlohmann::json;

namespace {

json entry(const std::string& question, const std::string& answer, const std::string& detail) {
  return {{"question", question}, {"answer", answer}, {"detail", detail}};
}

/// The last episode of which something is known under this pointer.
const json* last_episode_with(const json& report, const std::string& pointer) {
  const json& episodes = report.at("episodes");
  for (auto episode = episodes.rbegin(); episode != episodes.rend(); ++episode) {
    if (number_at(*episode, pointer)) {
      return &*episode;
    }
  }
  return nullptr;
}

/// Whether a prediction is all that the report can show.
bool is_prediction(const json& report) { return report.value("state", "") == "predicted"; }

std::string sentences(const std::vector<std::string>& parts) {
  std::string text;
  for (const std::string& part : parts) {
    text += (text.empty() ? "" : " ") + part;
  }
  return text;
}

/// Figures of an episode against their criteria.  Without a contraction factor nothing was extrapolated: the figure is
/// the last change.
std::vector<std::string> remaining_changes(const json& episode, const json& criteria) {
  std::vector<std::string> parts;
  if (const auto left_alone = number_at(episode, "/figures/left_alone")) {
    const auto error = number_at(episode, "/figures/temperature"), zone = number_at(episode, "/figures/cohesive_zone");
    if (error) {
      parts.push_back(fmt::format("Temperatures estimated to be off by at most {:.2g} % (wanted below {:.2g} %).",
                                  100 * *error, 100 * criteria.at("temperature").get<double>()));
    }
    if (zone) {
      parts.push_back(fmt::format("The zone by at most {:.2g} cells (wanted below {:.2g}).", *zone,
                                  criteria.at("cohesive_zone").get<double>()));
    }
    parts.push_back(fmt::format("Tracers left alone went {:.2g} % from their prediction.", 100 * *left_alone));
    return parts;
  }
  if (const auto value = number_at(episode, "/figures/temperature")) {
    parts.push_back(fmt::format("{} by {:.2g} % (wanted below {:.2g} %).",
                                number_at(episode, "/lambda/temperature") ? "Temperature still to change"
                                                                          : "Temperature changed in the last episode",
                                100 * *value, 100 * criteria.at("temperature").get<double>()));
  }
  if (const auto value = number_at(episode, "/figures/cohesive_zone")) {
    parts.push_back(fmt::format("{} by {:.2g} cells (wanted below {:.2g}).",
                                number_at(episode, "/lambda/cohesive_zone") ? "Cohesive zone still to move"
                                                                            : "Cohesive zone moved in the last episode",
                                *value, criteria.at("cohesive_zone").get<double>()));
  }
  if (const auto value = number_at(episode, "/figures/granular_velocity")) {
    parts.push_back(fmt::format(
        "Granular velocity differs from the episode before by {:.2g} standard errors (wanted below {:.2g}).", *value,
        criteria.at("granular_velocity").get<double>()));
  }
  return parts;
}

/// `temperature, cohesive zone`: the criteria that an episode does not meet.
std::string unmet_criteria(const json& episode) {
  std::string names;
  for (const auto& [rule, change] : episode.at("change").items()) {
    if (change.is_number() && change.get<double>() >= 1) {
      std::string name = rule;
      std::replace(name.begin(), name.end(), '_', ' ');
      names += (names.empty() ? "" : ", ") + name;
    }
  }
  return names;
}

/// Whether any criterion could be judged of an episode.
bool any_judged(const json& episode) {
  const json& change = episode.at("change");
  return std::any_of(change.begin(), change.end(), [](const json& value) { return value.is_number(); });
}

json has_it_converged(const json& report) {
  const std::string question = "Has it converged?";
  const std::string state = report.at("state");
  const auto number = static_cast<long long>(report.at("episodes").size());
  const json& criteria = report.at("criteria");
  if (is_prediction(report)) {
    return entry(
        question, "This is a prediction",
        report.at("prediction").at("converged").get<bool>()
            ? "A steady solution on streamlines; no stage of the campaign was run."
            : "A steady solution on streamlines was sought and not found; what is shown is the last iteration.");
  }
  if (state == "converged" && report.value("strategy", "") == "predict-and-verify") {
    return entry(question, "Yes, after " + counted(number, "DEM stage"),
                 report.at("predict_and_verify").at("sentence").get<std::string>());
  }
  if (state == "converged") {
    return entry(question, "Yes, after " + counted(number, "episode"),
                 fmt::format("All criteria were met in {} on end.", counted(criteria.at("for").get<int>(), "episode")));
  }
  if (state == "steady, ore not melted") {
    return entry(question, "Steady, but ore leaves unmelted",
                 "Nothing changes any more, yet too much of the ore leaves the furnace without having melted.");
  }
  if (state == "not converged at its limit") {
    const bool judged = number > 0 && any_judged(report.at("episodes").back());
    const std::string unmet = judged ? unmet_criteria(report.at("episodes").back()) : "";
    const std::string reason = !judged ? "Nothing could be judged yet: a change shows from the second episode on."
                               : unmet.empty() ? "The criteria were not met in enough episodes on end."
                                               : fmt::format("Not met: {}.", unmet);
    return entry(question, "No, not within " + counted(number, "episode"),
                 reason + " It can be resumed with a higher limit.");
  }
  if (state == "failed") {
    return entry(question, "No, it failed", report.at("description").get<std::string>());
  }
  return entry(question, "Not yet",
               fmt::format("Episode {} of at most {}.", std::max(number, 1LL), criteria.at("at_most").get<int>()));
}

json where_is_the_zone(const json& report) {
  const std::string question = "Where is the cohesive zone?";
  const json& furnace = report.at("furnace");
  const json* episode = last_episode_with(report, "/cohesive_zone/height_mean");
  if (episode == nullptr && is_prediction(report)) {
    const json& zone = report.at("prediction").at("cohesive_zone");
    if (!number_at(zone, "/height_mean")) {
      return entry(question, "There is none (prediction)", "No ore is predicted to melt within the bed.");
    }
    return entry(
        question,
        fmt::format("{:.2f} m on average, {:.2f} to {:.2f} m (prediction)", zone.at("height_mean").get<double>(),
                    number_at(zone, "/height_min").value_or(NAN), number_at(zone, "/height_max").value_or(NAN)),
        fmt::format("Predicted height above z = 0 at which the ore has melted ({:.0f} K), over all columns.",
                    furnace.at("melting_temperature").get<double>()));
  }
  if (episode == nullptr) {
    const bool tracer_done = last_episode_with(report, "/mean_solid_temperature") != nullptr;
    return tracer_done ? entry(question, "There is none", "No ore reaches its melting temperature within the bed.")
                       : entry(question, "Not known yet", "No tracer stage has ended.");
  }
  const json& zone = episode->at("cohesive_zone");
  std::vector<std::string> parts{
      fmt::format("Height above z = 0 at which the ore has melted ({:.0f} K), over all columns, after episode {}.",
                  furnace.at("melting_temperature").get<double>(), episode->at("index").get<int>())};
  if (const auto softening = number_at(*episode, "/tracer/softening_zone/height_mean")) {
    parts.push_back(fmt::format("Softening begins at {:.2f} m.", *softening));
  }
  if (const auto without = number_at(zone, "/columns_without"); without && *without > 0) {
    parts.push_back(fmt::format("{:.0f} columns hold no zone.", *without));
  }
  return entry(question,
               fmt::format("{:.2f} m on average, {:.2f} to {:.2f} m", zone.at("height_mean").get<double>(),
                           number_at(zone, "/height_min").value_or(NAN), number_at(zone, "/height_max").value_or(NAN)),
               sentences(parts));
}

json how_does_the_bed_move(const json& report) {
  const json* episode = last_episode_with(report, "/dem/packing_fraction");
  if (episode == nullptr) {
    return entry("How does the bed move?", "Not known yet", "No DEM stage has ended.");
  }
  return entry("How does the bed move?",
               fmt::format("Packed to {:.1f} % by volume", 100 * *number_at(*episode, "/dem/packing_fraction")),
               "A cold scene: no temperatures are computed.");
}

/// How well a ledger closes.
std::string closure(double residual) {
  constexpr double round_off = 1e-9;
  return residual < round_off ? "round-off" : fmt::format("{:.2g} %", 100 * residual);
}

json how_sure(const json& report) {
  const std::string question = "How sure is that?";
  std::vector<std::string> parts;
  if (is_prediction(report)) {
    const json& prediction = report.at("prediction");
    parts.emplace_back("A prediction: the bed's motion is a potential flow, not a DEM stage's.");
    if (const auto heat = number_at(prediction, "/energy_residual")) {
      parts.push_back(fmt::format("Its heat balance closes to {} of the blast's.", closure(*heat)));
    }
    const auto error = number_at(prediction, "/expected_error");
    return entry(question,
                 error ? fmt::format("Temperatures are expected to be {:.0f} % off", 100 * *error)
                       : std::string("Not known: predictions have not been compared with marches yet"),
                 sentences(parts));
  }
  std::string answer = "Nothing to judge yet";
  const json* episode = last_episode_with(report, "/change/granular_velocity");
  if (episode == nullptr) {
    episode = last_episode_with(report, "/change/temperature");
  }
  if (episode != nullptr) {
    double worst = 0;
    for (const auto& [rule, change] : episode->at("change").items()) {
      worst = std::max(worst, change.is_number() ? change.get<double>() : 0.);
    }
    answer = worst < 1 ? fmt::format("Remaining changes at most {:.0f} % of what is allowed", 100 * worst)
                       : fmt::format("Remaining changes up to {:.2g} times what is allowed", worst);
    parts = remaining_changes(*episode, report.at("criteria"));
  }
  if (const auto mass = number_at(report, "/ledger/mass_residual")) {
    const auto heat = number_at(report, "/ledger/energy_residual");
    parts.push_back(heat ? fmt::format("Mass closes to {} of the charge, heat to {} of the blast's.", closure(*mass),
                                       closure(*heat))
                         : fmt::format("Mass closes to {} of the charge.", closure(*mass)));
  }
  if (parts.empty()) {
    parts.emplace_back("A change can be judged from the second episode on.");
  }
  return entry(question, answer, sentences(parts));
}

json what_did_it_cost(const json& report) {
  double dem_process = 0, dem_wall = 0, tracer_process = 0, tracer_wall = 0;
  int ranks = 0;
  for (const json& episode : report.at("episodes")) {
    dem_process += number_at(episode, "/dem/process_seconds").value_or(0);
    dem_wall += number_at(episode, "/dem/wall_seconds").value_or(0);
    tracer_process += number_at(episode, "/tracer/process_seconds").value_or(0);
    tracer_wall += number_at(episode, "/tracer/wall_seconds").value_or(0);
    ranks = std::max(ranks, static_cast<int>(number_at(episode, "/dem/ranks").value_or(0)));
  }
  std::vector<std::string> parts;
  if (dem_wall > 0) {
    parts.push_back(
        fmt::format("DEM stages: {} of motion in {}.", duration_in_words(dem_process), duration_in_words(dem_wall)));
  }
  if (tracer_wall > 0) {
    parts.push_back(fmt::format("Tracer stages: {} of process time in {}.", duration_in_words(tracer_process),
                                duration_in_words(tracer_wall)));
  }
  return entry("What did it cost?",
               duration_in_words(report.at("wall_seconds").get<double>()) +
                   (ranks > 0 ? fmt::format(" on {} rank{}", ranks, ranks == 1 ? "" : "s") : ""),
               sentences(parts));
}

}  // namespace

std::string duration_in_words(double seconds) {
  if (!std::isfinite(seconds)) {
    return "an unknown time";
  }
  if (seconds < 60) {
    return fmt::format("{:.3g} s", seconds);
  }
  const auto whole = static_cast<long long>(std::llround(seconds));
  if (whole < 3600) {
    return whole % 60 == 0 ? fmt::format("{} min", whole / 60) : fmt::format("{} min {} s", whole / 60, whole % 60);
  }
  const long long minutes = (whole + 30) / 60;
  if (whole < 48LL * 3600) {
    return minutes % 60 == 0 ? fmt::format("{} h", minutes / 60)
                             : fmt::format("{} h {} min", minutes / 60, minutes % 60);
  }
  return fmt::format("{:.3g} days", seconds / 86400);
}

json answers(const json& report) {
  const bool hot = report.at("has_heat");
  return {{"converged", has_it_converged(report)},
          {"state_of_the_bed", hot ? where_is_the_zone(report) : how_does_the_bed_move(report)},
          {"certainty", how_sure(report)},
          {"wall_time", what_did_it_cost(report)}};
}

}  // namespace cupola
