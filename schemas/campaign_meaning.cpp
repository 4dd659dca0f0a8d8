#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <set>

#include "schemas/campaign_from_document.hpp"
#include "schemas/nearest.hpp"

namespace cupola {
namespace {

constexpr double skin = 0.1;  // of the largest diameter: neighbour lists of the DEM look that much further
constexpr double bulk_packing = 0.55;
constexpr double rounding = 1e-9;  // m

/// Every comparison is written so that NaN (missing, reported already) passes.
class Meaning {
 public:
  Meaning(const Campaign& campaign, YamlDocument& document) : campaign_(campaign), document_(document) {}

  void run() {
    for (const auto& species : campaign_.species) names_.push_back(species.name);
    geometry();
    species();
    contacts();
    gas();
    charging();
    raceways();
    stages();
  }

 private:
  template <typename... Arguments>
  void add(const std::string& path, fmt::format_string<Arguments...> text, Arguments&&... arguments) {
    document_.errors.push_back(document_.error_at(path, fmt::format(text, std::forward<Arguments>(arguments)...)));
  }

  [[nodiscard]] bool has(const std::string& path) const { return document_.values.contains(path); }
  [[nodiscard]] bool known(const std::string& name) const {
    return std::find(names_.begin(), names_.end(), name) != names_.end();
  }
  [[nodiscard]] bool shaped() const { return shaped_; }

  [[nodiscard]] std::string no_species(const std::string& name) const {
    return fmt::format("there is no species `{}`{}", name, suggestion(name, names_));
  }

  void geometry() {
    const auto& geometry = campaign_.scene.geometry;
    const auto& profile = geometry.profile;
    shaped_ = profile.size() > 1;
    for (std::size_t i = 0; i < profile.size(); ++i) {
      const auto row = path_of("scene.geometry.slot.profile", i);
      shaped_ = shaped_ && std::isfinite(profile[i][0]) && profile[i][1] > 0;
      if (profile[i][1] <= 0) add(row, "the half width must be greater than 0, but is {} m", profile[i][1]);
      if (i == 0 || !(profile[i][0] <= profile[i - 1][0])) continue;
      shaped_ = false;
      add(row, "z must rise from row to row, but {} m follows {} m", profile[i][0], profile[i - 1][0]);
    }
    const auto& mesh = campaign_.scene.mesh;
    if (has("scene.mesh") && !has("scene.mesh.cell") && !has("scene.mesh.cells")) {
      add("scene.mesh", "expected `cell` (an edge length like 0.2 m) or `cells` (counts)");
    }
    if (mesh.cells && shaped() && mesh.cells->heights.size() + 1 != profile.size()) {
      add("scene.mesh.cells.heights", "expected one count for each of the {} sections of the profile, but there are {}",
          profile.size() - 1, mesh.cells->heights.size());
    }
    if (!mesh.cells && shaped() && mesh.cell > 2 * campaign_.half_width(campaign_.top())) {
      add("scene.mesh.cell", "the cell of {} m is wider than the top, {} m", mesh.cell,
          2 * campaign_.half_width(campaign_.top()));
    }
    double largest = 0;
    for (const auto& species : campaign_.species) largest = std::fmax(largest, species.parcel_diameter());
    const double least = 2 * largest * (1 + skin);
    const auto kind = geometry.kind == Geometry::Kind::box ? "box" : "slot";
    if (geometry.sides == Geometry::Sides::periodic && geometry.depth < least) {
      add(fmt::format("scene.geometry.{}.depth", kind),
          "periodic sides need a depth of at least twice the largest parcel plus skin, {:.4g} m, but it is {} m: make "
          "it deeper, "
          "lower coarse_graining or set `sides: walls`",
          least, geometry.depth);
    }
  }

  void species() {
    for (const auto& species : campaign_.species) {
      const auto path = path_of("species", species.name);
      if (species.name == "wall")
        add(path, "`wall` is the name of the walls in contacts.pairs: give the species another");
      if (!species.softening) {
        if (has(path_of(path, "none_below")))
          add(path_of(path, "none_below"), "only a species with `softening` can have this");
        continue;
      }
      const auto& softening = *species.softening;
      if (softening.melted <= softening.from) {
        add(path_of(path, "softening.melted"),
            "the species melts at {} K, but softens only from {} K: it must soften before it melts", softening.melted,
            softening.from);
      }
      if (shaped() && species.none_below >= campaign_.top()) {
        add(path_of(path, "none_below"), "{} m is not below the top of the mesh, {} m", species.none_below,
            campaign_.top());
      }
    }
  }

  void contacts() {
    if (campaign_.contacts.model == Contacts::Model::linear_spring && has("contacts") && !has("contacts.stiffness")) {
      add("contacts", "the model linear-spring needs `stiffness` (like 1e4 N/m)");
    }
    if (!has("contacts.pairs") || campaign_.species.empty()) return;
    std::set<std::string> wanted;
    auto partners = names_;
    partners.emplace_back("wall");
    for (std::size_t i = 0; i < names_.size(); ++i) {
      for (std::size_t j = i; j < partners.size(); ++j) wanted.insert(names_[i] + "-" + partners[j]);
    }
    const auto& pairs = document_.root["contacts"]["pairs"];
    if (!pairs.is_object()) return;
    std::set<std::string> given;
    std::set<std::string> meant;
    for (const auto& [key, value] : pairs.items()) {
      const auto dash = key.find('-');
      const auto turned = dash == std::string::npos ? key : key.substr(dash + 1) + "-" + key.substr(0, dash);
      const auto name = wanted.contains(key) ? key : turned;
      if (!wanted.contains(name)) {
        const std::vector<std::string> candidates(wanted.begin(), wanted.end());
        if (const auto near = nearest_word(key, candidates)) meant.insert(*near);
        document_.errors.push_back(document_.error_at_key(
            path_of("contacts.pairs", key),
            fmt::format("`{}` is no pair of species, or of a species and `wall`{}", key, suggestion(key, candidates))));
      } else if (!given.insert(name).second) {
        add(path_of("contacts.pairs", key), "this pair is given twice: once as {}, once as {}", key, turned);
      }
    }
    for (const auto& name : wanted) {
      if (!given.contains(name) && !meant.contains(name)) add("contacts.pairs", "the pair `{}` is missing", name);
    }
  }

  void gas() {
    if (!campaign_.scene.gas) {
      for (const auto* path : {"heat", "scene.walls.heat_loss", "dem.gas", "tracer.gas"}) {
        const bool asks = path == std::string("dem.gas")      ? campaign_.dem.gas != DemSettings::GasModel::none
                          : path == std::string("tracer.gas") ? campaign_.tracer.gas != TracerSettings::GasModel::none
                                                              : has(path);
        if (asks && !has("scene.gas")) add(path, "this needs a gas, but the scene has none (scene.gas)");
      }
      return;
    }
    const auto& gas = *campaign_.scene.gas;
    if (campaign_.heat && campaign_.tracer.gas == TracerSettings::GasModel::none) {
      add("tracer.gas", "heat needs a gas model in the tracer stage, but `none` stands here");
    }
    if (has("scene.walls.heat_loss") && !has("heat")) add("scene.walls.heat_loss", "a heat loss needs `heat`");
    const std::array<std::pair<const char*, double>, 4> properties{{{"molar_mass", gas.molar_mass},
                                                                    {"heat_capacity", gas.heat_capacity},
                                                                    {"viscosity", gas.viscosity},
                                                                    {"prandtl", gas.prandtl}}};
    for (const auto& [key, value] : properties) {
      if (std::isnan(value) && has("scene.gas.species") && !has(path_of("scene.gas", key))) {
        add("scene.gas.species", "`{}` is not a known gas (air, nitrogen, blast){}: give its `{}`", gas.species,
            suggestion(gas.species, {"air", "nitrogen", "blast"}), key);
      }
    }
    for (std::size_t i = 0; i < gas.inlets.size(); ++i) inlet(i);
  }

  void inlet(std::size_t index) {
    const auto& inlets = campaign_.scene.gas->inlets;
    const auto& inlet = inlets[index];
    const auto path = path_of("scene.gas.inlets", index);
    static const std::set<std::string> patches{"wall", "bottom", "outlet", "front", "back"};
    if (patches.contains(inlet.name))
      add(path_of(path, "name"), "`{}` is a patch of the mesh already: choose another name", inlet.name);
    const bool in_side = inlet.side != Inlet::Side::bottom;
    for (const auto* key : {"z", "size"}) {
      if (in_side && has(path_of(path, "side")) && !has(path_of(path, key)))
        add(path, "an inlet in a side wall needs `{}`", key);
      if (!in_side && has(path_of(path, key)))
        add(path_of(path, key), "the bottom is an inlet as a whole: leave `{}` out", key);
    }
    for (std::size_t other = 0; other < index; ++other) {
      const auto& before = inlets[other];
      if (!inlet.name.empty() && before.name == inlet.name)
        add(path_of(path, "name"), "the name `{}` is taken by inlet {}", inlet.name, other);
      if (before.side != inlet.side) continue;
      if (!in_side || std::abs(before.z - inlet.z) < (before.size[1] + inlet.size[1]) / 2 - rounding) {
        add(path, "it overlaps the inlet `{}` in the same wall", before.name);
      }
    }
    if (in_side && shaped()) opening(inlet, path);
  }

  void opening(const Inlet& inlet, const std::string& path) {
    const double low = inlet.z - inlet.size[1] / 2;
    const double high = inlet.z + inlet.size[1] / 2;
    const double depth = campaign_.scene.geometry.depth;
    if (inlet.size[0] > depth + rounding) {
      add(path_of(path_of(path, "size"), std::size_t{0}), "the opening is {} m along y, but the wall only {} m",
          inlet.size[0], depth);
    }
    if (low < campaign_.bottom() - rounding || high > campaign_.top() + rounding) {
      add(path_of(path, "z"), "the opening from {:.4g} to {:.4g} m is outside the wall, which goes from {} to {} m",
          low, high, campaign_.bottom(), campaign_.top());
      return;
    }
    for (const auto& [z, width] : campaign_.scene.geometry.profile) {
      if (z > low + rounding && z < high - rounding) {
        add(path_of(path, "z"),
            "the opening from {:.4g} to {:.4g} m lies over the profile's corner at {} m: move it or make it lower", low,
            high, z);
      }
    }
  }

  void charging() {
    const auto& charging = campaign_.charging;
    for (std::size_t i = 0; i < charging.layers.size(); ++i) {
      const auto path = path_of("charging.layers", i);
      double volume = 0;
      for (const auto& [name, mass] : charging.layers[i]) {
        if (known(name)) {
          volume += mass / campaign_.species[campaign_.species_index(name)].density / bulk_packing;
        } else if (!names_.empty()) {
          document_.errors.push_back(document_.error_at_key(path_of(path, name), no_species(name)));
        }
      }
      if (shaped()) batch(path, volume);
    }
    if (!shaped()) return;
    if (charging.stock_line <= campaign_.bottom() || charging.stock_line > campaign_.hopper_top() + rounding) {
      add("charging.stock_line", "{} m is not between the bottom, {} m, and the top of the charging hopper, {:.4g} m",
          charging.stock_line, campaign_.bottom(), campaign_.hopper_top());
    }
  }

  /// MODEL of the charge: what is charged at once must find room between the stock line and the hopper's top.
  void batch(const std::string& path, double volume) {
    const auto& geometry = campaign_.scene.geometry;
    const double stock_line = std::max(campaign_.charging.stock_line, campaign_.bottom());
    double room =
        2 * campaign_.half_width(campaign_.top()) * (campaign_.hopper_top() - std::max(stock_line, campaign_.top()));
    for (std::size_t i = 1; i < geometry.profile.size(); ++i) {
      const double low = std::max(geometry.profile[i - 1][0], stock_line);
      const double high = geometry.profile[i][0];
      if (low < high) room += (campaign_.half_width(low) + campaign_.half_width(high)) * (high - low);
    }
    room *= geometry.depth;
    if (volume > room * (1 + rounding)) {
      add(path,
          "the layer takes {:.4g} m3, but there are only {:.4g} m3 between the stock line and the top of the charging "
          "hopper: charge "
          "less at once, lower the stock line or raise charging.hopper_height",
          volume, room);
    }
  }

  void raceways() {
    static const std::array<const char*, 3> axes{"x", "y", "z"};
    for (std::size_t i = 0; i < campaign_.raceways.size(); ++i) {
      const auto& box = campaign_.raceways[i].box;
      const auto path = path_of(path_of("raceways", i), "box");
      for (std::size_t axis = 0; axis < 3; ++axis) {
        if (box[1][axis] <= box[0][axis]) add(path_of(path, axes[axis]), "expected [from, to] with from < to");
      }
      if (!shaped() || !(box[0][2] < box[1][2])) continue;
      const double depth = campaign_.scene.geometry.depth;
      if (box[0][2] < campaign_.bottom() - rounding || box[1][2] > campaign_.top() + rounding) {
        add(path_of(path, "z"), "the box reaches outside the furnace, which goes from {} to {} m", campaign_.bottom(),
            campaign_.top());
      }
      if (box[0][1] < -depth / 2 - rounding || box[1][1] > depth / 2 + rounding) {
        add(path_of(path, "y"), "the box reaches outside the furnace, which goes from {} to {} m", -depth / 2,
            depth / 2);
      }
      double widest = std::max(campaign_.half_width(box[0][2]), campaign_.half_width(box[1][2]));
      for (const auto& [z, width] : campaign_.scene.geometry.profile) {
        if (z > box[0][2] && z < box[1][2]) widest = std::max(widest, width);
      }
      if (box[0][0] < -widest - rounding || box[1][0] > widest + rounding) {
        add(path_of(path, "x"), "the box reaches outside the furnace, which goes from {} to {} m there", -widest,
            widest);
      }
    }
    if (has("descent_rate") && campaign_.descent_rate == 0 && !campaign_.raceways.empty()) {
      add("descent_rate", "a bed with raceways descends: expected a speed greater than 0");
    }
  }

  void stages() {
    const auto& dem = campaign_.dem;
    if (dem.relaxation + dem.window > dem.at_most * (1 + rounding)) {
      add(has("dem.stop.at_most") ? "dem.stop.at_most" : "dem.window",
          "relaxation ({} s) and averaging window ({} s) do not fit into the longest time of the stage, {} s",
          dem.relaxation, dem.window, dem.at_most);
    }
    if (dem.block > dem.window)
      add("dem.block", "the block of {} s is longer than the averaging window, {} s", dem.block, dem.window);
    if (dem.time_step && *dem.time_step > dem.block)
      add("dem.time_step", "the step is longer than the block, {} s", dem.block);
    if (campaign_.tracer.time_step && *campaign_.tracer.time_step > campaign_.tracer.duration) {
      add("tracer.time_step", "the step is longer than the stage, {} s", campaign_.tracer.duration);
    }
    if (campaign_.converged.for_episodes > campaign_.converged.at_most) {
      add("converged.for", "{} episodes in a row cannot happen in at most {}", campaign_.converged.for_episodes,
          campaign_.converged.at_most);
    }
    if (const auto& v = campaign_.initial.cohesive_zone; v && v->below <= v->above) {
      add("initial.cohesive_zone.inverted_v.below", "it must be hotter below the zone ({} K) than above it ({} K)",
          v->below, v->above);
    }
  }

  const Campaign& campaign_;
  YamlDocument& document_;
  std::vector<std::string> names_;
  bool shaped_ = false;  ///< the profile is there and sound
};

}  // namespace

void check_meaning(const Campaign& campaign, YamlDocument& document) { Meaning(campaign, document).run(); }

}  // namespace cupola
