#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <set>

#include "schemas/campaign_meaning.hpp"
#include "schemas/nearest.hpp"

namespace cupola::meaning {
namespace {

const std::vector<std::string> words_for_gas{"air", "nitrogen", "blast"};

void check_opening(Context& context, const Inlet& inlet, const std::string& path) {
  const auto& campaign = context.campaign;
  const double low = inlet.z - inlet.size[1] / 2;
  const double high = inlet.z + inlet.size[1] / 2;
  const double depth = campaign.scene.geometry.depth;
  if (inlet.size[0] > depth + rounding) {
    context.add(path_of(path_of(path, "size"), std::size_t{0}), "the opening is {} m along y, but the wall only {} m",
                inlet.size[0], depth);
  }
  if (low < campaign.bottom() - rounding || high > campaign.top() + rounding) {
    context.add(path_of(path, "z"),
                "the opening from {:.4g} to {:.4g} m is outside the wall, which goes from {} to {} m", low, high,
                campaign.bottom(), campaign.top());
    return;
  }
  for (const auto& [z, width] : campaign.scene.geometry.profile) {
    if (z > low + rounding && z < high - rounding) {
      context.add(
          path_of(path, "z"),
          "the opening from {:.4g} to {:.4g} m lies over the profile's corner at {} m: move it or make it lower", low,
          high, z);
    }
  }
}

/// An inlet states one of three.  Where another key is misspelt, that has been said already.
void check_what_flows_in(Context& context, const std::string& path) {
  std::vector<std::string> given;
  for (const auto* key : {"mass_flow", "velocity", "pressure"}) {
    if (context.has(path_of(path, key))) given.emplace_back(key);
  }
  if (given.size() > 1) {
    context.add(path_of(path, given[1]), "an inlet states one of mass_flow, velocity and pressure, but here stand {}",
                fmt::join(given, " and "));
  }
  const auto reported = [&](const CampaignError& error) { return error.key.starts_with(path + "."); };
  if (given.empty() && std::none_of(context.document.errors.begin(), context.document.errors.end(), reported)) {
    context.add_at_key(path,
                       "one of the keys mass_flow, velocity and pressure is missing: expected a mass flow (like "
                       "1.4 kg/s)");
  }
}

void check_pressure(Context& context, const Inlet& inlet, const std::string& path) {
  const double outlet = context.campaign.scene.gas->outlet_pressure;
  if (inlet.given == Inlet::Given::pressure && inlet.pressure <= outlet) {
    context.add(path_of(path, "pressure"), "no gas flows in at {} Pa against {} Pa at the outlet", inlet.pressure,
                outlet);
  }
}

void check_janaf(Context& context) {
  const auto& janaf = context.campaign.scene.gas->janaf;
  if (janaf.from >= janaf.common || janaf.common >= janaf.to) {
    context.add(context.has("scene.gas.janaf") ? "scene.gas.janaf" : "scene.gas",
                "expected from < common < to, but these are {}, {} and {} K", janaf.from, janaf.common, janaf.to);
  }
}

void check_inlet(Context& context, std::size_t index) {
  const auto& campaign = context.campaign;
  const auto& inlets = campaign.scene.gas->inlets;
  const auto& inlet = inlets[index];
  const auto path = path_of("scene.gas.inlets", index);
  static const std::set<std::string> patches{"wall", "bottom", "outlet", "front", "back"};
  if (patches.contains(inlet.name))
    context.add(path_of(path, "name"), "`{}` is a patch of the mesh already: choose another name", inlet.name);
  check_what_flows_in(context, path);
  check_pressure(context, inlet, path);
  const bool in_side = inlet.side != Inlet::Side::bottom;
  for (const auto* key : {"z", "size"}) {
    if (in_side && context.has(path_of(path, "side")) && !context.has(path_of(path, key)))
      context.add(path, "an inlet in a side wall needs `{}`", key);
    if (!in_side && context.has(path_of(path, key)))
      context.add(path_of(path, key), "the bottom is an inlet as a whole: leave `{}` out", key);
  }
  for (std::size_t other = 0; other < index; ++other) {
    const auto& before = inlets[other];
    if (!inlet.name.empty() && before.name == inlet.name)
      context.add(path_of(path, "name"), "the name `{}` is taken by inlet {}", inlet.name, other);
    if (before.side != inlet.side) continue;
    if (!in_side || std::abs(before.z - inlet.z) < (before.size[1] + inlet.size[1]) / 2 - rounding) {
      context.add(path, "it overlaps the inlet `{}` in the same wall", before.name);
    }
  }
  if (in_side && context.shaped) check_opening(context, inlet, path);
}

}  // namespace

void check_gas(Context& context) {
  const auto& campaign = context.campaign;
  if (!campaign.scene.gas) {
    for (const auto* path : {"heat", "scene.walls.heat_loss", "dem.gas", "tracer.gas"}) {
      const bool asks = path == std::string("dem.gas")      ? campaign.dem.gas != DemSettings::GasModel::none
                        : path == std::string("tracer.gas") ? campaign.tracer.gas != TracerSettings::GasModel::none
                                                            : context.has(path);
      if (asks && !context.has("scene.gas")) context.add(path, "this needs a gas, but the scene has none (scene.gas)");
    }
    return;
  }
  const auto& gas = *campaign.scene.gas;
  if (campaign.heat && campaign.tracer.gas == TracerSettings::GasModel::none) {
    context.add("tracer.gas", "heat needs a gas model in the tracer stage, but `none` stands here");
  }
  if (context.has("scene.walls.heat_loss") && !context.has("heat"))
    context.add("scene.walls.heat_loss", "a heat loss needs `heat`");
  const std::array<std::pair<const char*, double>, 4> properties{{{"molar_mass", gas.molar_mass},
                                                                  {"heat_capacity", gas.heat_capacity},
                                                                  {"viscosity", gas.viscosity},
                                                                  {"prandtl", gas.prandtl}}};
  std::vector<std::string> missing;
  for (const auto& [key, value] : properties) {
    if (std::isnan(value) && !context.has(path_of("scene.gas", key))) missing.emplace_back(key);
  }
  const bool known = std::find(words_for_gas.begin(), words_for_gas.end(), gas.species) != words_for_gas.end();
  const std::array<std::pair<const char*, bool>, 2> models{
      {{"sutherland", gas.viscosity_model == Gas::ViscosityModel::sutherland},
       {"janaf", gas.heat_capacity_model == Gas::HeatCapacityModel::janaf}}};
  for (const auto& [key, asked] : models) {
    if (asked && !known && !context.has(path_of("scene.gas", key)))
      context.add("scene.gas", "this gas needs the key `{}`", key);
  }
  check_janaf(context);
  if (!missing.empty() && context.has("scene.gas.species")) {
    context.add("scene.gas.species", "`{}` is not a known gas (air, nitrogen, blast){}: expected one, or also its {}",
                gas.species, suggestion(gas.species, words_for_gas), fmt::join(missing, ", "));
  }
  constexpr double molar_gas_constant = 8.314462618;  // J/mol/K
  const double least_heat_capacity = molar_gas_constant / gas.molar_mass;
  if (gas.heat_capacity <= least_heat_capacity) {
    context.add("scene.gas.heat_capacity",
                "{} J/kg/K at constant pressure is not possible for an ideal gas of {} kg/mol: it must exceed the gas "
                "constant, {:.4g} J/kg/K",
                gas.heat_capacity, gas.molar_mass, least_heat_capacity);
  }
  for (std::size_t i = 0; i < gas.inlets.size(); ++i) check_inlet(context, i);
}

}  // namespace cupola::meaning
