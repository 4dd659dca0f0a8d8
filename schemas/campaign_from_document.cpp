#include "schemas/campaign_from_document.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "schemas/campaign_words.hpp"
#include "schemas/gas_presets.hpp"

namespace cupola {
namespace {

using Json = nlohmann::ordered_json;

constexpr double unknown = std::numeric_limits<double>::quiet_NaN();
constexpr double bulk_packing = 0.55;            // of a charged layer, for its thickness
constexpr double longest_checkpoint_wait = 600;  // s before a job's limit

/// A section of the document; reading leaves the default where a key is absent and NaN where its number is no number.
class Section {
 public:
  explicit Section(const Json* node) : node_(node != nullptr && node->is_object() ? node : nullptr) {}

  [[nodiscard]] bool present() const { return node_ != nullptr; }
  [[nodiscard]] const Json* find(const std::string& key) const {
    return node_ != nullptr && node_->contains(key) ? &node_->at(key) : nullptr;
  }
  [[nodiscard]] Section section(const std::string& key) const { return Section(find(key)); }
  [[nodiscard]] std::vector<Section> list(const std::string& key) const {
    std::vector<Section> sections;
    const auto* value = find(key);
    if (value != nullptr && value->is_array()) {
      for (const auto& item : *value) sections.emplace_back(&item);
    }
    return sections;
  }
  [[nodiscard]] const Json& members() const {
    static const Json none = Json::object();
    return node_ != nullptr ? *node_ : none;
  }

  void read(const std::string& key, double& value) const {
    if (const auto* found = find(key)) value = found->is_number() ? found->get<double>() : unknown;
  }
  void need(const std::string& key, double& value) const {
    value = unknown;
    read(key, value);
  }
  void read(const std::string& key, std::optional<double>& value) const {
    const auto* found = find(key);
    if (found != nullptr && found->is_number()) value = found->get<double>();
  }
  void read(const std::string& key, int& value) const {
    const auto* found = find(key);
    if (found != nullptr && found->is_number_integer()) value = found->get<int>();
  }
  void read(const std::string& key, bool& value) const {
    const auto* found = find(key);
    if (found != nullptr && found->is_boolean()) value = found->get<bool>();
  }
  void read(const std::string& key, std::string& value) const {
    const auto* found = find(key);
    if (found != nullptr && found->is_string()) value = found->get<std::string>();
  }
  void read(const std::string& key, std::vector<std::string>& value) const {
    const auto* found = find(key);
    if (found == nullptr || !found->is_array()) return;
    for (const auto& item : *found) value.push_back(item.is_string() ? item.get<std::string>() : "");
  }
  void read(const std::string& key, std::array<double, 2>& value) const {
    value = {unknown, unknown};
    if (const auto* found = find(key)) value = two_numbers(*found);
  }
  template <typename Enum, std::size_t count>
  void read(const std::string& key, Enum& value, const words::Table<Enum, count>& table) const {
    std::string text;
    read(key, text);
    for (const auto& [enumerator, word] : table) {
      if (word == text) value = enumerator;
    }
  }

  /// A number, or a table of rows [temperature, value]; NaN where it is neither.
  void read(const std::string& key, PropertyCurve& value) const {
    const auto* found = find(key);
    if (found == nullptr) return;
    if (!found->is_array()) {
      double constant = unknown;
      read(key, constant);
      value = constant;
      return;
    }
    std::vector<std::array<double, 2>> rows;
    for (const auto& row : *found) rows.push_back(two_numbers(row));
    value = rows.empty() ? PropertyCurve(unknown) : PropertyCurve(std::move(rows));
  }
  template <std::size_t count>
  void read(const std::string& key, std::array<double, count>& values) const {
    const auto* found = find(key);
    if (found == nullptr || !found->is_array()) return;
    for (std::size_t i = 0; i < count; ++i)
      values[i] = i < found->size() && found->at(i).is_number() ? found->at(i).get<double>() : unknown;
  }

  static std::array<double, 2> two_numbers(const Json& value) {
    if (!value.is_array() || value.size() != 2 || !value[0].is_number() || !value[1].is_number())
      return {unknown, unknown};
    return {value[0].get<double>(), value[1].get<double>()};
  }

 private:
  const Json* node_;
};

Geometry read_geometry(const Section& section) {
  Geometry geometry;
  geometry.depth = unknown;
  if (const auto slot = section.section("slot"); slot.present()) {
    geometry.kind = Geometry::Kind::slot;
    slot.need("depth", geometry.depth);
    slot.read("sides", geometry.sides, words::sides);
    if (const auto* profile = slot.find("profile"); profile != nullptr && profile->is_array()) {
      for (const auto& row : *profile) geometry.profile.push_back(Section::two_numbers(row));
    }
  } else if (const auto box = section.section("box"); box.present()) {
    geometry.kind = Geometry::Kind::box;
    box.need("depth", geometry.depth);
    box.read("sides", geometry.sides, words::sides);
    double width = 0;
    double height = 0;
    box.need("width", width);
    box.need("height", height);
    geometry.profile = {{0, width / 2}, {height, width / 2}};
  }
  return geometry;
}

MeshSettings read_mesh(const Section& section, const Geometry& geometry) {
  MeshSettings mesh;
  if (const auto cells = section.section("cells"); cells.present()) {
    mesh.cells.emplace();
    cells.read("half_width", mesh.cells->half_width);
    cells.read("depth", mesh.cells->depth);
    if (const auto* heights = cells.find("heights"); heights != nullptr && heights->is_array()) {
      for (const auto& count : *heights)
        mesh.cells->heights.push_back(count.is_number_integer() ? count.get<int>() : 0);
    }
    int layers = 0;
    for (const int count : mesh.cells->heights) layers += count;
    if (layers > 0 && geometry.profile.size() > 1)
      mesh.cell = (geometry.profile.back()[0] - geometry.profile.front()[0]) / layers;
  }
  section.read("cell", mesh.cell);
  return mesh;
}

Gas read_gas(const Section& section) {
  Gas gas;
  section.read("species", gas.species);
  const auto& presets = gas_presets();
  const auto preset =
      std::find_if(presets.begin(), presets.end(), [&](const GasPreset& one) { return one.name == gas.species; });
  const bool known = preset != presets.end();
  gas.molar_mass = known ? preset->molar_mass : unknown;
  gas.heat_capacity = known ? preset->heat_capacity : unknown;
  gas.viscosity = known ? preset->viscosity : unknown;
  gas.prandtl = known ? preset->prandtl : unknown;
  section.read("molar_mass", gas.molar_mass);
  section.read("heat_capacity", gas.heat_capacity);
  section.read("viscosity", gas.viscosity);
  section.read("prandtl", gas.prandtl);
  section.read("viscosity_model", gas.viscosity_model, words::viscosity_model);
  gas.sutherland = known ? preset->sutherland : Sutherland{unknown, unknown, unknown};
  if (const auto own = section.section("sutherland"); own.present()) {
    own.need("viscosity", gas.sutherland.viscosity);
    own.need("at", gas.sutherland.at);
    own.need("constant", gas.sutherland.constant);
  }
  section.read("heat_capacity_model", gas.heat_capacity_model, words::heat_capacity_model);
  gas.janaf = known ? preset->janaf : JanafPolynomials{unknown, unknown, unknown, {}, {}};
  if (const auto own = section.section("janaf"); own.present()) {
    own.need("from", gas.janaf.from);
    own.need("common", gas.janaf.common);
    own.need("to", gas.janaf.to);
    own.read("low", gas.janaf.low);
    own.read("high", gas.janaf.high);
  }
  for (const auto& item : section.list("inlets")) {
    Inlet inlet;
    item.read("name", inlet.name);
    item.read("side", inlet.side, words::inlet_side);
    if (inlet.side != Inlet::Side::bottom) {
      item.need("z", inlet.z);
      item.read("size", inlet.size);
    }
    if (item.find("velocity") != nullptr) {
      inlet.given = Inlet::Given::velocity;
      item.need("velocity", inlet.velocity);
    } else if (item.find("pressure") != nullptr) {
      inlet.given = Inlet::Given::pressure;
      item.need("pressure", inlet.pressure);
    } else {
      item.need("mass_flow", inlet.mass_flow);
    }
    item.need("total_temperature", inlet.total_temperature);
    gas.inlets.push_back(inlet);
  }
  section.section("outlet").read("pressure", gas.outlet_pressure);
  return gas;
}

Scene read_scene(const Section& section) {
  Scene scene;
  scene.geometry = read_geometry(section.section("geometry"));
  scene.mesh = read_mesh(section.section("mesh"), scene.geometry);
  if (const auto gas = section.section("gas"); gas.present()) scene.gas = read_gas(gas);
  if (const auto loss = section.section("walls").section("heat_loss"); loss.present()) {
    scene.heat_loss.emplace();
    loss.need("coefficient", scene.heat_loss->coefficient);
    loss.read("ambient", scene.heat_loss->ambient);
    loss.read("on", scene.heat_loss->on, words::heat_loss_on);
  }
  return scene;
}

Species read_species(const std::string& name, const Section& section) {
  Species species;
  species.name = name;
  section.need("diameter", species.diameter);
  section.read("coarse_graining", species.coarse_graining);
  section.need("density", species.density);
  section.read("heat_capacity", species.heat_capacity);
  section.read("conductivity", species.conductivity);
  if (const auto softening = section.section("softening"); softening.present()) {
    species.softening.emplace();
    softening.need("from", species.softening->from);
    softening.need("melted", species.softening->melted);
    softening.read("latent_heat", species.softening->latent_heat);
  }
  section.need("none_below", species.none_below);
  return species;
}

/// "ore-coke" becomes "coke-ore", the order of `species`.
std::string ordered_pair(const std::string& key, const std::vector<Species>& species) {
  const auto dash = key.find('-');
  if (dash == std::string::npos) return key;
  const auto rank = [&](const std::string& name) {
    if (name == "wall") return species.size();
    return static_cast<std::size_t>(
        std::find_if(species.begin(), species.end(), [&](const Species& s) { return s.name == name; }) -
        species.begin());
  };
  const auto first = key.substr(0, dash);
  const auto second = key.substr(dash + 1);
  return rank(second) < rank(first) ? second + "-" + first : key;
}

Contacts read_contacts(const Section& section, const std::vector<Species>& species) {
  Contacts contacts;
  section.read("model", contacts.model, words::contact_model);
  section.read("rolling_model", contacts.rolling_model, words::rolling_model);
  section.read("youngs_modulus", contacts.youngs_modulus);
  section.read("wall_youngs_modulus", contacts.wall_youngs_modulus);
  section.read("poisson_ratio", contacts.poisson_ratio);
  section.read("rolling_damping", contacts.rolling_damping);
  section.read("stiffness", contacts.stiffness);
  section.read("stiffness_of", contacts.stiffness_of, words::stiffness_of);
  section.read("tangential_ratio", contacts.tangential_ratio);
  for (const auto& [key, value] : section.section("pairs").members().items()) {
    const Section item(&value);
    ContactPair pair;
    item.need("restitution", pair.restitution);
    item.need("friction", pair.friction);
    item.need("rolling", pair.rolling);
    contacts.pairs.emplace(ordered_pair(key, species), pair);
  }
  return contacts;
}

Charging read_charging(const Section& section) {
  Charging charging;
  section.need("stock_line", charging.stock_line);
  if (const auto* layers = section.find("layers"); layers != nullptr && layers->is_array()) {
    for (const auto& item : *layers) {
      Layer layer;
      const Section masses(&item);
      for (const auto& [name, mass] : masses.members().items()) {
        if (name != "ring") masses.need(name, layer[name]);
      }
      charging.layers.push_back(layer);
      charging.rings.emplace_back();
      if (masses.find("ring") != nullptr) masses.read("ring", charging.rings.back().emplace());
    }
  }
  section.read("temperature", charging.temperature);
  section.need("hopper_height", charging.hopper_height);
  return charging;
}

std::array<Vector3, 2> read_box(const Section& section) {
  std::array<Vector3, 2> box{};
  const std::array<std::string, 3> axes{"x", "y", "z"};
  for (std::size_t axis = 0; axis < 3; ++axis) {
    std::array<double, 2> range{};
    section.read(axes[axis], range);
    box[0][axis] = range[0];
    box[1][axis] = range[1];
  }
  return box;
}

Raceway read_raceway(const Section& section) {
  Raceway raceway;
  raceway.box = read_box(section.section("box"));
  section.read("void", raceway.void_fraction);
  section.need("dem_removal_rate", raceway.dem_removal_rate);
  section.read("removal", raceway.removal, words::raceway_removal);
  return raceway;
}

DemSettings read_dem(const Section& section, bool gas) {
  DemSettings dem;
  dem.gas = gas ? DemSettings::GasModel::quasi_steady : DemSettings::GasModel::none;
  section.read("engine", dem.engine);
  section.read("gas", dem.gas, words::dem_gas);
  section.section("stop").read("when", dem.stop, words::dem_stop);
  section.section("stop").read("at_most", dem.at_most);
  section.read("relaxation", dem.relaxation);
  section.read("window", dem.window);
  section.read("standard_error", dem.standard_error);
  section.read("time_step", dem.time_step);
  section.read("rayleigh_fraction", dem.rayleigh_fraction);
  section.read("block", dem.block);
  section.read("void_fraction", dem.void_fraction, words::void_fraction);
  section.need("smoothing_length", dem.smoothing_length);
  const auto transient = section.section("transient");
  transient.read("time_step", dem.transient.time_step);
  transient.read("courant", dem.transient.courant);
  transient.read("corrections", dem.transient.corrections);
  transient.read("turbulence", dem.transient.turbulence, words::turbulence);
  const auto limits = section.section("limits");
  limits.read("overlap", dem.limits.overlap);
  limits.read("wall_overlap", dem.limits.wall_overlap);
  limits.read("creep", dem.limits.creep);
  return dem;
}

TracerSettings read_tracer(const Section& section, bool gas) {
  TracerSettings tracer;
  tracer.gas = gas ? TracerSettings::GasModel::darcy_forchheimer : TracerSettings::GasModel::none;
  section.read("duration", tracer.duration);
  section.read("time_step", tracer.time_step);
  section.read("gas", tracer.gas, words::tracer_gas);
  section.read("resolve", tracer.resolve, words::tracer_resolve);
  section.read("compare_gas_models", tracer.compare_gas_models);
  section.read("accuracy", tracer.accuracy);
  const auto stop = section.section("stop");
  stop.read("when", tracer.stop, words::tracer_stop);
  tracer.at_most = tracer.duration;
  stop.read("at_most", tracer.at_most);
  tracer.remaining_change = tracer.accuracy;
  stop.read("remaining_change", tracer.remaining_change);
  section.read("tracers_per_cell", tracer.tracers_per_cell);
  section.read("clean_field", tracer.clean_field);
  section.read("smoothing_passes", tracer.smoothing_passes);
  section.read("displacement", tracer.displacement, words::displacement);
  section.read("displacement_coefficient", tracer.displacement_coefficient);
  section.read("displacement_limit", tracer.displacement_limit);
  section.read("relaxation_coefficient", tracer.relaxation_coefficient);
  section.read("relaxation_limit", tracer.relaxation_limit);
  const auto excludes = section.section("displacement_excludes");
  excludes.read("above_cohesive_zone", tracer.displacement_excludes.above_cohesive_zone);
  for (const auto& box : excludes.list("boxes")) tracer.displacement_excludes.boxes.push_back(read_box(box));
  return tracer;
}

Launch read_launch(const Section& section) {
  Launch launch;
  section.read("ranks", launch.ranks);
  const auto cluster = section.section("slurm");
  if (!cluster.present()) return launch;
  SlurmLaunch& slurm = launch.slurm.emplace();
  cluster.read("ranks", launch.ranks);
  cluster.need("time", slurm.time);
  slurm.checkpoint_before = std::fmin(longest_checkpoint_wait, slurm.time / 4);
  cluster.read("checkpoint_before", slurm.checkpoint_before);
  cluster.read("partition", slurm.partition);
  cluster.read("account", slurm.account);
  cluster.read("qos", slurm.qos);
  cluster.read("nodes", slurm.nodes);
  cluster.read("starter", slurm.starter, words::slurm_starter);
  cluster.read("options", slurm.options);
  cluster.read("setup", slurm.setup);
  return launch;
}

/// Height of the thickest layer in the throat, m; NaN where it cannot be known.
double thickest_layer(const Campaign& campaign) {
  if (campaign.scene.geometry.profile.size() < 2) return unknown;
  const double throat = 2 * campaign.half_width(campaign.top()) * campaign.scene.geometry.depth;
  double thickest = 0;
  for (const auto& layer : campaign.charging.layers) {
    double height = 0;
    for (const auto& [name, mass] : layer) {
      for (const auto& species : campaign.species) {
        if (species.name == name) height += mass / species.density / bulk_packing / throat;
      }
    }
    thickest = std::max(height, thickest);
  }
  return thickest;
}

void derive(Campaign& campaign) {
  const bool shaped = campaign.scene.geometry.profile.size() > 1;
  double lowest = shaped ? campaign.bottom() : unknown;
  if (!campaign.raceways.empty()) {
    lowest = unknown;
    for (const auto& raceway : campaign.raceways) lowest = std::fmax(lowest, raceway.box[1][2] + 1);
  }
  for (auto& species : campaign.species) {
    if (std::isnan(species.none_below)) species.none_below = lowest;
  }
  auto& smoothing = campaign.dem.smoothing_length;
  if (std::isnan(smoothing)) {
    smoothing = campaign.species.empty() ? unknown : 0;
    for (const auto& species : campaign.species) smoothing = std::max(smoothing, species.parcel_diameter());
  }
  auto& hopper = campaign.charging.hopper_height;
  if (std::isnan(hopper)) hopper = thickest_layer(campaign) + 0.5;
}

}  // namespace

Campaign campaign_from_document(const YamlDocument& document) {
  const Section root(&document.root);
  Campaign campaign;
  root.read("campaign", campaign.name);
  campaign.scene = read_scene(root.section("scene"));
  for (const auto& [name, value] : root.section("species").members().items()) {
    campaign.species.push_back(read_species(name, Section(&value)));
  }
  campaign.contacts = read_contacts(root.section("contacts"), campaign.species);
  root.read("drag", campaign.drag, words::drag);
  if (const auto filtered = root.section("filtered_drag"); filtered.present()) {
    campaign.filtered_drag.emplace();
    filtered.read("parcel_coefficient", campaign.filtered_drag->parcel_coefficient);
    filtered.read("grid", campaign.filtered_drag->grid);
  }
  if (const auto heat = root.section("heat"); heat.present()) {
    campaign.heat.emplace();
    heat.read("nusselt_factor", campaign.heat->nusselt_factor);
    heat.read("convection", campaign.heat->convection, words::convection);
    heat.read("bed_conduction", campaign.heat->bed_conduction, words::bed_conduction);
    heat.read("emissivity", campaign.heat->emissivity);
    heat.read("intragrain_resistance", campaign.heat->intragrain_resistance);
  }
  if (const auto v = root.section("initial").section("cohesive_zone").section("inverted_v"); v.present()) {
    auto& guess = campaign.initial.cohesive_zone.emplace();
    v.need("tip", guess.tip);
    v.need("slope", guess.slope);
    v.need("below", guess.below);
    v.need("above", guess.above);
  }
  campaign.charging = read_charging(root.section("charging"));
  for (const auto& item : root.list("raceways")) campaign.raceways.push_back(read_raceway(item));
  if (const auto dead_man = root.section("dead_man"); dead_man.present()) {
    campaign.dead_man.emplace();
    dead_man.need("tip", campaign.dead_man->tip);
    dead_man.read("slope", campaign.dead_man->slope);
  }
  root.need("descent_rate", campaign.descent_rate);
  campaign.dem = read_dem(root.section("dem"), campaign.scene.gas.has_value());
  campaign.tracer = read_tracer(root.section("tracer"), campaign.scene.gas.has_value());
  root.read("strategy", campaign.strategy, words::strategy);
  root.section("predict_and_verify").read("windows", campaign.predict_and_verify.windows);
  const auto converged = root.section("converged");
  converged.read("temperature", campaign.converged.temperature);
  converged.read("cohesive_zone", campaign.converged.cohesive_zone_cells);
  converged.read("granular_velocity", campaign.converged.granular_velocity_sigma);
  converged.read("for", campaign.converged.for_episodes);
  converged.read("at_most", campaign.converged.at_most);
  campaign.launch = read_launch(root.section("launch"));
  if (const auto* seed = root.find("random_seed"); seed != nullptr && seed->is_number_integer()) {
    campaign.random_seed = seed->get<std::uint64_t>();
  }
  derive(campaign);
  return campaign;
}

}  // namespace cupola
