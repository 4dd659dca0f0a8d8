#include "schemas/resolved_campaign.hpp"

#include "schemas/campaign_words.hpp"
#include "schemas/yaml_text.hpp"

namespace cupola {
namespace {

using Json = nlohmann::ordered_json;

template <typename Enum, std::size_t count>
std::string word(const words::Table<Enum, count>& table, Enum value) {
  return std::string(words::word_of(table, value));
}

Json or_auto(const std::optional<double>& value) { return value ? Json(*value) : Json("auto"); }

Json geometry_json(const Geometry& geometry) {
  const auto sides = word(words::sides, geometry.sides);
  if (geometry.kind == Geometry::Kind::box) {
    return {{"box",
             {{"width", 2 * geometry.profile.back()[1]},
              {"depth", geometry.depth},
              {"height", geometry.profile.back()[0]},
              {"sides", sides}}}};
  }
  return {{"slot", {{"depth", geometry.depth}, {"sides", sides}, {"profile", geometry.profile}}}};
}

Json gas_json(const Gas& gas) {
  Json inlets = Json::array();
  for (const auto& inlet : gas.inlets) {
    Json item{{"name", inlet.name}, {"side", word(words::inlet_side, inlet.side)}};
    if (inlet.side != Inlet::Side::bottom) {
      item["z"] = inlet.z;
      item["size"] = inlet.size;
    }
    if (inlet.given == Inlet::Given::mass_flow) item["mass_flow"] = inlet.mass_flow;
    if (inlet.given == Inlet::Given::velocity) item["velocity"] = inlet.velocity;
    if (inlet.given == Inlet::Given::pressure) item["pressure"] = inlet.pressure;
    item["total_temperature"] = inlet.total_temperature;
    inlets.push_back(item);
  }
  Json json{{"species", gas.species},
            {"molar_mass", gas.molar_mass},
            {"heat_capacity", gas.heat_capacity},
            {"viscosity", gas.viscosity},
            {"prandtl", gas.prandtl},
            {"viscosity_model", word(words::viscosity_model, gas.viscosity_model)},
            {"heat_capacity_model", word(words::heat_capacity_model, gas.heat_capacity_model)}};
  if (gas.viscosity_model == Gas::ViscosityModel::sutherland) {
    json["sutherland"] = {
        {"viscosity", gas.sutherland.viscosity}, {"at", gas.sutherland.at}, {"constant", gas.sutherland.constant}};
  }
  if (gas.heat_capacity_model == Gas::HeatCapacityModel::janaf) {
    const auto& janaf = gas.janaf;
    json["janaf"] = {
        {"from", janaf.from}, {"common", janaf.common}, {"to", janaf.to}, {"low", janaf.low}, {"high", janaf.high}};
  }
  json["inlets"] = inlets;
  json["outlet"] = {{"pressure", gas.outlet_pressure}};
  return json;
}

Json scene_json(const Scene& scene) {
  Json json{{"geometry", geometry_json(scene.geometry)}, {"mesh", {{"cell", scene.mesh.cell}}}};
  if (const auto& cells = scene.mesh.cells) {
    json["mesh"]["cells"] = {{"half_width", cells->half_width}, {"depth", cells->depth}, {"heights", cells->heights}};
  }
  if (scene.gas) json["gas"] = gas_json(*scene.gas);
  if (scene.heat_loss) {
    json["walls"] = {{"heat_loss",
                      {{"coefficient", scene.heat_loss->coefficient},
                       {"ambient", scene.heat_loss->ambient},
                       {"on", word(words::heat_loss_on, scene.heat_loss->on)}}}};
  }
  return json;
}

Json curve_json(const PropertyCurve& curve) {
  return curve.is_constant() ? Json(curve.points().front()[1]) : Json(curve.points());
}

Json species_json(const Species& species) {
  Json json{{"diameter", species.diameter}, {"coarse_graining", species.coarse_graining}, {"density", species.density}};
  // Zero: left out of the file of a cold scene.
  if (species.heat_capacity.points().front()[1] != 0) json["heat_capacity"] = curve_json(species.heat_capacity);
  if (species.conductivity.points().front()[1] != 0) json["conductivity"] = curve_json(species.conductivity);
  if (species.softening) {
    json["softening"] = {{"from", species.softening->from},
                         {"melted", species.softening->melted},
                         {"latent_heat", species.softening->latent_heat}};
    json["none_below"] = species.none_below;
  }
  return json;
}

Json contacts_json(const Contacts& contacts) {
  Json json{{"model", word(words::contact_model, contacts.model)},
            {"rolling_model", word(words::rolling_model, contacts.rolling_model)},
            {"youngs_modulus", contacts.youngs_modulus},
            {"wall_youngs_modulus", contacts.wall_youngs_modulus},
            {"poisson_ratio", contacts.poisson_ratio}};
  if (contacts.rolling_model == Contacts::Rolling::epsd) json["rolling_damping"] = contacts.rolling_damping;
  if (contacts.stiffness > 0) json["stiffness"] = contacts.stiffness;
  if (contacts.model == Contacts::Model::linear_spring) {
    json["stiffness_of"] = word(words::stiffness_of, contacts.stiffness_of);
    json["tangential_ratio"] = contacts.tangential_ratio;
  }
  for (const auto& [name, pair] : contacts.pairs) {
    json["pairs"][name] = {{"restitution", pair.restitution}, {"friction", pair.friction}, {"rolling", pair.rolling}};
  }
  return json;
}

Json box_json(const std::array<Vector3, 2>& box) {
  const auto range = [&](std::size_t axis) { return Json::array({box[0][axis], box[1][axis]}); };
  return {{"x", range(0)}, {"y", range(1)}, {"z", range(2)}};
}

Json layers_json(const Charging& charging) {
  Json json = Json::array();
  for (std::size_t i = 0; i < charging.layers.size(); ++i) {
    json.push_back(charging.layers[i]);
    if (const auto ring = charging.ring_of(i)) json.back()["ring"] = *ring;
  }
  return json;
}

Json raceways_json(const std::vector<Raceway>& raceways) {
  Json json = Json::array();
  for (const auto& raceway : raceways) {
    json.push_back({{"box", box_json(raceway.box)},
                    {"void", raceway.void_fraction},
                    {"dem_removal_rate", raceway.dem_removal_rate},
                    {"removal", word(words::raceway_removal, raceway.removal)}});
  }
  return json;
}

Json dem_json(const DemSettings& dem) {
  Json json{
      {"engine", dem.engine},
      {"gas", word(words::dem_gas, dem.gas)},
      {"stop", {{"when", word(words::dem_stop, dem.stop)}, {"at_most", dem.at_most}}},
      {"relaxation", dem.relaxation},
      {"window", dem.window},
      {"standard_error", dem.standard_error},
      {"time_step", or_auto(dem.time_step)},
      {"rayleigh_fraction", dem.rayleigh_fraction},
      {"block", dem.block},
      {"void_fraction", word(words::void_fraction, dem.void_fraction)},
      {"smoothing_length", dem.smoothing_length},
      {"limits",
       {{"overlap", dem.limits.overlap}, {"wall_overlap", dem.limits.wall_overlap}, {"creep", dem.limits.creep}}}};
  if (dem.gas == DemSettings::GasModel::transient) {
    json["transient"] = {{"time_step", or_auto(dem.transient.time_step)},
                         {"courant", dem.transient.courant},
                         {"corrections", dem.transient.corrections},
                         {"turbulence", word(words::turbulence, dem.transient.turbulence)}};
  }
  return json;
}

Json tracer_json(const TracerSettings& tracer) {
  Json stop{{"when", word(words::tracer_stop, tracer.stop)}};
  if (tracer.stop == TracerSettings::Stop::steady) {
    stop["at_most"] = tracer.at_most;
    stop["remaining_change"] = tracer.remaining_change;
  }
  Json boxes = Json::array();
  for (const auto& box : tracer.displacement_excludes.boxes) boxes.push_back(box_json(box));
  return {{"duration", tracer.duration},
          {"stop", stop},
          {"time_step", or_auto(tracer.time_step)},
          {"gas", word(words::tracer_gas, tracer.gas)},
          {"resolve", word(words::tracer_resolve, tracer.resolve)},
          {"compare_gas_models", tracer.compare_gas_models},
          {"accuracy", tracer.accuracy},
          {"tracers_per_cell", tracer.tracers_per_cell},
          {"clean_field", tracer.clean_field},
          {"smoothing_passes", tracer.smoothing_passes},
          {"displacement", word(words::displacement, tracer.displacement)},
          {"displacement_coefficient", tracer.displacement_coefficient},
          {"displacement_limit", tracer.displacement_limit},
          {"relaxation_coefficient", tracer.relaxation_coefficient},
          {"relaxation_limit", tracer.relaxation_limit},
          {"displacement_excludes",
           {{"above_cohesive_zone", tracer.displacement_excludes.above_cohesive_zone}, {"boxes", boxes}}}};
}

Json initial_json(const Initial& initial) {
  Json json{{"bed", "layered"}};
  if (const auto& v = initial.cohesive_zone) {
    json["cohesive_zone"]["inverted_v"] = {
        {"tip", v->tip}, {"slope", v->slope}, {"below", v->below}, {"above", v->above}};
  }
  return json;
}

Json launch_json(const Launch& launch) {
  if (!launch.slurm) return {{"ranks", launch.ranks}};
  const SlurmLaunch& slurm = *launch.slurm;
  Json json{{"ranks", launch.ranks}, {"time", slurm.time}, {"checkpoint_before", slurm.checkpoint_before}};
  if (!slurm.partition.empty()) json["partition"] = slurm.partition;
  if (!slurm.account.empty()) json["account"] = slurm.account;
  if (!slurm.qos.empty()) json["qos"] = slurm.qos;
  if (slurm.nodes > 0) json["nodes"] = slurm.nodes;
  json["starter"] = word(words::slurm_starter, slurm.starter);
  if (!slurm.options.empty()) json["options"] = slurm.options;
  if (!slurm.setup.empty()) json["setup"] = slurm.setup;
  return {{"slurm", json}};
}

}  // namespace

Json resolved_json(const Campaign& campaign) {
  Json json{{"campaign", campaign.name}, {"scene", scene_json(campaign.scene)}};
  for (const auto& species : campaign.species) json["species"][species.name] = species_json(species);
  json["contacts"] = contacts_json(campaign.contacts);
  json["drag"] = word(words::drag, campaign.drag);
  if (const auto& heat = campaign.heat) {
    json["heat"] = {{"nusselt_factor", heat->nusselt_factor},
                    {"convection", word(words::convection, heat->convection)},
                    {"bed_conduction", word(words::bed_conduction, heat->bed_conduction)},
                    {"emissivity", heat->emissivity},
                    {"intragrain_resistance", heat->intragrain_resistance}};
  }
  if (campaign.filtered_drag) {
    json["filtered_drag"] = {{"parcel_coefficient", campaign.filtered_drag->parcel_coefficient},
                             {"grid", campaign.filtered_drag->grid}};
  }
  json["initial"] = initial_json(campaign.initial);
  const auto& charging = campaign.charging;
  json["charging"] = {{"stock_line", charging.stock_line},
                      {"layers", layers_json(charging)},
                      {"temperature", charging.temperature},
                      {"hopper_height", charging.hopper_height}};
  json["raceways"] = raceways_json(campaign.raceways);
  if (campaign.dead_man) json["dead_man"] = {{"tip", campaign.dead_man->tip}, {"slope", campaign.dead_man->slope}};
  json["descent_rate"] = campaign.descent_rate;
  json["dem"] = dem_json(campaign.dem);
  json["tracer"] = tracer_json(campaign.tracer);
  json["strategy"] = word(words::strategy, campaign.strategy);
  if (campaign.strategy == Strategy::predict_and_verify)
    json["predict_and_verify"] = {{"windows", campaign.predict_and_verify.windows}};
  json["converged"] = {{"temperature", campaign.converged.temperature},
                       {"cohesive_zone", campaign.converged.cohesive_zone_cells},
                       {"granular_velocity", campaign.converged.granular_velocity_sigma},
                       {"for", campaign.converged.for_episodes},
                       {"at_most", campaign.converged.at_most}};
  json["launch"] = launch_json(campaign.launch);
  json["random_seed"] = campaign.random_seed;
  return json;
}

std::string resolved_yaml(const Campaign& campaign) { return yaml_text(resolved_json(campaign)); }

}  // namespace cupola
