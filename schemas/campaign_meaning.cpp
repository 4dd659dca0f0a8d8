#include "schemas/campaign_meaning.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "schemas/campaign_from_document.hpp"

namespace cupola {
namespace meaning {

Context::Context(const Campaign& campaign_to_check, YamlDocument& its_document)
    : campaign(campaign_to_check), document(its_document) {
  const auto sound = [](char c) {
    return (c >= '0' && c <= '9') || (c >= 'A' && c <= 'Z') || (c >= 'a' && c <= 'z') || c == '_';
  };
  for (const auto& species : campaign.species) {
    names.push_back(species.name);
    named = named && species.name != "wall" && std::all_of(species.name.begin(), species.name.end(), sound);
  }
}

bool Context::known(const std::string& name) const {
  return std::find(names.begin(), names.end(), name) != names.end();
}

namespace {

constexpr double skin = 0.1;  // of the largest diameter: neighbour lists of the DEM look that much further

void check_geometry(Context& context) {
  const auto& campaign = context.campaign;
  const auto& geometry = campaign.scene.geometry;
  const auto& profile = geometry.profile;
  context.shaped = profile.size() > 1;
  for (std::size_t i = 0; i < profile.size(); ++i) {
    const auto row = path_of("scene.geometry.slot.profile", i);
    context.shaped = context.shaped && std::isfinite(profile[i][0]) && profile[i][1] > 0;
    if (profile[i][1] <= 0) context.add(row, "the half width must be greater than 0, but is {} m", profile[i][1]);
    if (i == 0 || !(profile[i][0] <= profile[i - 1][0])) continue;
    context.shaped = false;
    context.add(row, "z must rise from row to row, but {} m follows {} m", profile[i][0], profile[i - 1][0]);
  }
  const auto& mesh = campaign.scene.mesh;
  if (context.has("scene.mesh") && !context.has("scene.mesh.cell") && !context.has("scene.mesh.cells")) {
    context.add("scene.mesh", "expected `cell` (an edge length like 0.2 m) or `cells` (counts)");
  }
  if (mesh.cells && context.shaped && mesh.cells->heights.size() + 1 != profile.size()) {
    context.add("scene.mesh.cells.heights",
                "expected one count for each of the {} sections of the profile, but there are {}", profile.size() - 1,
                mesh.cells->heights.size());
  }
  if (!mesh.cells && context.shaped && mesh.cell > 2 * campaign.half_width(campaign.top())) {
    context.add("scene.mesh.cell", "the cell of {} m is wider than the top, {} m", mesh.cell,
                2 * campaign.half_width(campaign.top()));
  }
  double largest = 0;
  for (const auto& species : campaign.species) largest = std::fmax(largest, species.parcel_diameter());
  const double least = 2 * largest * (1 + skin);
  const auto kind = geometry.kind == Geometry::Kind::box ? "box" : "slot";
  if (geometry.sides == Geometry::Sides::periodic && geometry.depth < least) {
    context.add(
        fmt::format("scene.geometry.{}.depth", kind),
        "periodic sides need a depth of at least twice the largest parcel plus skin, {:.4g} m, but it is {} m: make "
        "it deeper, "
        "lower coarse_graining or set `sides: walls`",
        least, geometry.depth);
  }
}

void check_curve(Context& context, const PropertyCurve& curve, const std::string& path) {
  const auto& rows = curve.points();
  for (std::size_t i = 1; i < rows.size(); ++i) {
    if (rows[i][0] <= rows[i - 1][0])
      context.add(path_of(path, i), "temperatures must rise from row to row, but {} K follows {} K", rows[i][0],
                  rows[i - 1][0]);
  }
}

void check_species(Context& context) {
  const auto& campaign = context.campaign;
  for (const auto& species : campaign.species) {
    const auto path = path_of("species", species.name);
    if (species.name == "wall")
      context.add(path, "`wall` is the name of the walls in contacts.pairs: give the species another");
    if (species.name == "ring") context.add(path, "`ring` is a key of charging.layers: give the species another name");
    for (const auto& [key, like] : {std::pair{"heat_capacity", "850 J/kg/K"}, {"conductivity", "1.7 W/m/K"}})
      if (context.has("heat") && !context.has(path_of(path, key)))
        context.add_at_key(path, "the key `{}` is missing: with `heat` every species needs it (like {})", key, like);
    check_curve(context, species.heat_capacity, path_of(path, "heat_capacity"));
    check_curve(context, species.conductivity, path_of(path, "conductivity"));
    if (!species.softening) {
      if (context.has(path_of(path, "none_below")))
        context.add(path_of(path, "none_below"), "only a species with `softening` can have this");
      continue;
    }
    const auto& softening = *species.softening;
    if (softening.melted <= softening.from) {
      context.add(path_of(path, "softening.melted"),
                  "the species melts at {} K, but softens only from {} K: it must soften before it melts",
                  softening.melted, softening.from);
    }
    if (context.shaped && species.none_below >= campaign.top()) {
      context.add(path_of(path, "none_below"), "{} m is not below the top of the mesh, {} m", species.none_below,
                  campaign.top());
    }
  }
}

void check_raceways(Context& context) {
  const auto& campaign = context.campaign;
  static const std::array<const char*, 3> axes{"x", "y", "z"};
  for (std::size_t i = 0; i < campaign.raceways.size(); ++i) {
    const auto& box = campaign.raceways[i].box;
    const auto path = path_of(path_of("raceways", i), "box");
    for (std::size_t axis = 0; axis < 3; ++axis) {
      if (box[1][axis] <= box[0][axis]) context.add(path_of(path, axes[axis]), "expected [from, to] with from < to");
    }
    if (!context.shaped || !(box[0][2] < box[1][2])) continue;
    const double depth = campaign.scene.geometry.depth;
    if (box[0][2] < campaign.bottom() - rounding || box[1][2] > campaign.top() + rounding) {
      context.add(path_of(path, "z"), "the box reaches outside the furnace, which goes from {} to {} m",
                  campaign.bottom(), campaign.top());
    }
    if (box[0][1] < -depth / 2 - rounding || box[1][1] > depth / 2 + rounding) {
      context.add(path_of(path, "y"), "the box reaches outside the furnace, which goes from {} to {} m", -depth / 2,
                  depth / 2);
    }
    double widest = std::max(campaign.half_width(box[0][2]), campaign.half_width(box[1][2]));
    for (const auto& [z, width] : campaign.scene.geometry.profile) {
      if (z > box[0][2] && z < box[1][2]) widest = std::max(widest, width);
    }
    if (box[0][0] < -widest - rounding || box[1][0] > widest + rounding) {
      context.add(path_of(path, "x"), "the box reaches outside the furnace, which goes from {} to {} m there", -widest,
                  widest);
    }
  }
  if (context.has("descent_rate") && campaign.descent_rate == 0 && !campaign.raceways.empty()) {
    context.add("descent_rate", "a bed with raceways descends: expected a speed greater than 0");
  }
}

void check_dead_man(Context& context) {
  const auto& campaign = context.campaign;
  if (!context.shaped || !context.has("dead_man.tip")) return;
  if (campaign.dead_man->tip <= campaign.bottom() || campaign.dead_man->tip >= campaign.charging.stock_line) {
    context.add("dead_man.tip", "{} m is not between the bottom, {} m, and the stock line, {} m",
                campaign.dead_man->tip, campaign.bottom(), campaign.charging.stock_line);
  }
}

void check_stages(Context& context) {
  const auto& campaign = context.campaign;
  const auto& dem = campaign.dem;
  if (dem.relaxation + dem.window > dem.at_most * (1 + rounding)) {
    context.add(context.has("dem.stop.at_most") ? "dem.stop.at_most" : "dem.window",
                "relaxation ({} s) and averaging window ({} s) do not fit into the longest time of the stage, {} s",
                dem.relaxation, dem.window, dem.at_most);
  }
  if (context.has("dem.transient") && dem.gas != DemSettings::GasModel::transient)
    context.add("dem.transient", "only the transient gas makes steps of its own (dem.gas: transient)");
  if (dem.block > dem.window)
    context.add("dem.block", "the block of {} s is longer than the averaging window, {} s", dem.block, dem.window);
  if (dem.time_step && *dem.time_step > dem.block)
    context.add("dem.time_step", "the step is longer than the block, {} s", dem.block);
  if (campaign.tracer.time_step && *campaign.tracer.time_step > campaign.tracer.longest()) {
    context.add("tracer.time_step", "the step is longer than the stage, {} s", campaign.tracer.longest());
  }
  if (campaign.tracer.stop == TracerSettings::Stop::duration) {
    for (const auto* path : {"tracer.stop.at_most", "tracer.stop.remaining_change"}) {
      if (context.has(path)) context.add(path, "this needs `when: steady`; by itself an episode lasts tracer.duration");
    }
  }
  if (campaign.tracer.stop == TracerSettings::Stop::steady && !campaign.heat && context.has("tracer.stop.when")) {
    context.add("tracer.stop.when", "`steady` is judged by the temperatures, but the scene has no `heat`");
  }
  for (std::size_t i = 0; i < campaign.tracer.displacement_excludes.boxes.size(); ++i) {
    const auto& box = campaign.tracer.displacement_excludes.boxes[i];
    const auto path = path_of("tracer.displacement_excludes.boxes", i);
    for (std::size_t axis = 0; axis < 3; ++axis) {
      if (box[1][axis] <= box[0][axis])
        context.add(path_of(path, std::string(1, "xyz"[axis])), "expected [from, to] with from < to");
    }
  }
  if (campaign.converged.for_episodes > campaign.converged.at_most) {
    context.add("converged.for", "{} episodes in a row cannot happen in at most {}", campaign.converged.for_episodes,
                campaign.converged.at_most);
  }
  if (const auto& v = campaign.initial.cohesive_zone; v && v->below <= v->above) {
    context.add("initial.cohesive_zone.inverted_v.below",
                "it must be hotter below the zone ({} K) than above it ({} K)", v->below, v->above);
  }
}

/// Predictions need what the predictor solves for, and a march to verify them whose length is not asked for elsewhere.
void check_strategy(Context& context) {
  const auto& campaign = context.campaign;
  if (campaign.strategy != Strategy::predict_and_verify) {
    if (context.has("predict_and_verify"))
      context.add("predict_and_verify", "this needs `strategy: predict-and-verify`");
    return;
  }
  if (!campaign.heat) context.add("strategy", "a prediction needs `heat`; a cold scene: `strategy: march`");
  if (campaign.raceways.empty())
    context.add("strategy", "a prediction needs a bed that descends into `raceways`; without them: `strategy: march`");
  if (campaign.tracer.stop == TracerSettings::Stop::steady)
    context.add(context.has("tracer.stop.when") ? "tracer.stop.when" : "strategy",
                "`steady` does not go with predict-and-verify, which marches `predict_and_verify.windows` layer "
                "passages and `tracer.duration` where a prediction fails");
}

}  // namespace
}  // namespace meaning

void check_meaning(const Campaign& campaign, YamlDocument& document) {
  meaning::Context context(campaign, document);
  meaning::check_geometry(context);
  meaning::check_species(context);
  meaning::check_contacts(context);
  meaning::check_gas(context);
  meaning::check_charging(context);
  meaning::check_raceways(context);
  meaning::check_dead_man(context);
  meaning::check_stages(context);
  meaning::check_strategy(context);
  meaning::check_launch(context);
}

}  // namespace cupola
