#include <fmt/ranges.h>

#include <array>
#include <cmath>
#include <set>

#include "schemas/campaign_meaning.hpp"
#include "schemas/nearest.hpp"

namespace cupola::meaning {
namespace {

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

void check_inlet(Context& context, std::size_t index) {
  const auto& campaign = context.campaign;
  const auto& inlets = campaign.scene.gas->inlets;
  const auto& inlet = inlets[index];
  const auto path = path_of("scene.gas.inlets", index);
  static const std::set<std::string> patches{"wall", "bottom", "outlet", "front", "back"};
  if (patches.contains(inlet.name))
    context.add(path_of(path, "name"), "`{}` is a patch of the mesh already: choose another name", inlet.name);
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
  if (!missing.empty() && context.has("scene.gas.species")) {
    context.add("scene.gas.species", "`{}` is not a known gas (air, nitrogen, blast){}: expected one, or also its {}",
                gas.species, suggestion(gas.species, {"air", "nitrogen", "blast"}), fmt::join(missing, ", "));
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
