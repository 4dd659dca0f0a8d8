#include "orchestrator/report/warnings.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "orchestrator/report/json_numbers.hpp"
#include "physics/closures/biot.hpp"

namespace cupola {

using nlohmann::json;

namespace {

constexpr double noticeable_unmelted_share = 1e-3;  // of the charge
constexpr double converged_unmelted_share = 0.05;   // MODEL 4: above it a campaign is not converged
constexpr double greatest_energy_residual = 5e-3;   // of the blast
constexpr double greatest_scale_difference = 0.10;  // MODEL 3: removal against the flux below the stock line
constexpr double noticeable_mach_number = 0.3;

void add_unmelted(const json& episode, std::vector<std::string>& list) {
  const auto charged = number_at(episode, "/tracer/ledger/mass/in");
  const auto unmelted = number_at(episode, "/tracer/ledger/mass/out/unmelted");
  if (!charged || !unmelted || *charged <= 0 || *unmelted < noticeable_unmelted_share * *charged) {
    return;
  }
  const double share = *unmelted / *charged;
  list.push_back(fmt::format(
      "Unmelted ore: {:.2g} % of the charge of episode {} got below the height where no ore may be, without "
      "having melted{}.",
      100 * share, episode.at("index").get<int>(),
      share > converged_unmelted_share ? "; the heat balance of this furnace does not hold the zone up" : ""));
}

void add_clamps(const json& episode, std::vector<std::string>& list) {
  const json::json_pointer place("/tracer/clamps");
  if (!episode.contains(place) || !episode.at(place).is_object()) {
    return;
  }
  for (const auto& [name, number] : episode.at(place).items()) {
    if (!number.is_number() || number.get<double>() <= 0) {
      continue;
    }
    const int index = episode.at("index").get<int>();
    if (name == "void_fraction_cells") {
      list.push_back(fmt::format(
          "Tracer stage {}: in {:.0f} cells the bed is denser than the gas model allows; there the gas sees the "
          "least void fraction.",
          index, number.get<double>()));
    } else {
      std::string words = name;
      std::replace(words.begin(), words.end(), '_', ' ');
      list.push_back(fmt::format("Tracer stage {}: a limit of the model was met: {} ({:.6g}).", index, words,
                                 number.get<double>()));
    }
  }
}

void add_dem(const json& episode, std::vector<std::string>& list) {
  const int index = episode.at("index").get<int>();
  if (const auto starved = number_at(episode, "/dem/starved_seconds"); starved && *starved > 0) {
    list.push_back(fmt::format("Starvation: in DEM stage {} a raceway found too few grains to remove for {:.2g} s.",
                               index, *starved));
  }
  if (const auto fast = number_at(episode, "/dem/fast_parcels"); fast && *fast > 0) {
    list.push_back(fmt::format("DEM stage {}: parcels faster than 5 m/s were seen {:.0f} times.", index, *fast));
  }
}

/// Grains that are not at one temperature inside, and the march takes them as if they were.
void add_biot(const json& episode, std::vector<std::string>& list) {
  const json::json_pointer place("/tracer/biot_largest");
  if (!episode.contains(place) || episode.value(json::json_pointer("/tracer/intragrain_resistance"), false)) return;
  for (const auto& [species, number] : episode.at(place).items()) {
    if (!number.is_number() || number.get<double>() <= biot_to_flag) continue;
    list.push_back(fmt::format(
        "Tracer stage {}: the Biot number of {} reaches {:.2g}: its grains are not at one temperature inside; "
        "heat.intragrain_resistance: true takes that into account.",
        episode.at("index").get<int>(), species, number.get<double>()));
  }
}

/// What the two gas models say of one state, where the campaign asked.
void add_gas_models(const json& episode, std::vector<std::string>& list) {
  const json::json_pointer place("/tracer/gas_models");
  if (!episode.contains(place)) return;
  const json& compared = episode.at(place);
  const int index = episode.at("index").get<int>();
  if (compared.contains("failed")) {
    list.push_back(fmt::format("Tracer stage {}: the gas models could not be compared: {}.", index,
                               compared.at("failed").get<std::string>()));
    return;
  }
  for (const json& row : compared.value("rows", json::array())) {
    const auto flux = number_at(row, "/mass_flux");
    const auto pressure = number_at(row, "/pressure");
    const auto from = number_at(row, "/from");
    const auto to = number_at(row, "/to");
    if (!flux || !pressure || !from) continue;
    list.push_back(
        fmt::format("Gas models in tracer stage {}, {} of an inlet: mass flux differs by {:.2g} %, pressure by "
                    "{:.2g} % between Navier-Stokes and Darcy-Forchheimer.",
                    index, to ? fmt::format("{:.1f} to {:.1f} m", *from, *to) : fmt::format("beyond {:.1f} m", *from),
                    100 * *flux, 100 * *pressure));
  }
}

void add_tracer(const json& episode, std::vector<std::string>& list) {
  const int index = episode.at("index").get<int>();
  if (const auto residual = number_at(episode, "/tracer/energy_residual");
      residual && *residual > greatest_energy_residual) {
    list.push_back(
        fmt::format("Tracer stage {}: {:.2g} % of the blast's heat is not accounted for.", index, 100 * *residual));
  }
  if (const auto check = number_at(episode, "/tracer/scale_check");
      check && std::abs(*check) > greatest_scale_difference) {
    list.push_back(fmt::format(
        "Tracer stage {}: what passes the middle of the shaft and does not melt differs by {:.0f} % from what the "
        "raceways remove; the DEM stage was not steady yet.",
        index, 100 * std::abs(*check)));
  }
  for (const json& inlet : episode.value(json::json_pointer("/tracer/inlets"), json::array())) {
    if (const auto mach = number_at(inlet, "/mach"); mach && *mach > noticeable_mach_number) {
      list.push_back(fmt::format("Tracer stage {}: the blast leaves {} at Mach {:.2f}.", index,
                                 inlet.value("name", "a tuyere"), *mach));
    }
  }
}

}  // namespace

std::vector<std::string> warnings(const json& report) {
  std::vector<std::string> list;
  for (const json& stage : report.at("results")) {
    const std::string state = stage.at("state");
    if (state == "failed" || state == "damaged") {
      list.push_back(fmt::format("{} stage {}: {}: {}", stage.at("stage").get<std::string>(),
                                 stage.at("episode").get<int>(), state, stage.at("sentence").get<std::string>()));
    }
  }
  for (const json& retry : report.at("retries")) {
    list.push_back(retry.get<std::string>());
  }
  const json& episodes = report.at("episodes");
  if (report.value("state", "") == "predicted") {
    for (const json& sentence : report.at("prediction").at("warnings")) list.push_back(sentence.get<std::string>());
  }
  for (const json& episode : episodes) {
    add_dem(episode, list);
    add_tracer(episode, list);
    add_clamps(episode, list);
    add_biot(episode, list);
    add_gas_models(episode, list);
  }
  // Ore may leave unmelted on the way to the steady state; what counts is how it ended.
  for (auto episode = episodes.rbegin(); episode != episodes.rend(); ++episode) {
    if (number_at(*episode, "/tracer/ledger/mass/in")) {
      add_unmelted(*episode, list);
      break;
    }
  }
  return list;
}

}  // namespace cupola
