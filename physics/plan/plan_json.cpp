#include <algorithm>

#include "physics/plan/plan.hpp"

namespace cupola {
namespace {

using nlohmann::json;

json optional_number(const std::optional<double>& value) { return value ? json(*value) : json(nullptr); }

json heat_json(const Plan& plan) {
  const HeatBalance& heat = *plan.heat;
  const CounterCurrentSolution& profile = heat.profile;
  json species = json::array(), columns = json::object();
  for (std::size_t k = 0; k < heat.kinds.size(); ++k) {
    const std::size_t i = heat.kinds[k];
    species.push_back({{"name", plan.species[i].name},
                       {"transfer_units", heat.transfer_units[i]},
                       {"softening_height", optional_number(heat.softening_height[i])},
                       {"melting_height", optional_number(heat.melting_height[i])},
                       {"leaves_at", heat.leaves_at[i]},
                       {"heat_taken", profile.to_solids[k]}});
  }
  constexpr std::size_t most_rows = 200;
  const std::size_t stride = profile.depth.size() / most_rows + 1;
  for (std::size_t n = 0; n < profile.depth.size(); n += stride) {
    columns["height"].push_back(plan.stock_line - profile.depth[n]);
    columns["gas"].push_back(profile.gas_temperature[n]);
    for (std::size_t k = 0; k < heat.kinds.size(); ++k) {
      const bool there = profile.depth[n] <= profile.end_depth[k];
      columns[plan.species[heat.kinds[k]].name].push_back(there ? json(profile.solids_temperature[k][n])
                                                                : json(nullptr));
    }
  }
  return {{"ratio", heat.ratio()},
          {"gas_heat_capacity_flow", heat.gas_heat_capacity_flow},
          {"solids_heat_capacity_flow", heat.solids_heat_capacity_flow},
          {"gas_mass_flow", heat.gas_mass_flow},
          {"gas_temperature", heat.gas_temperature},
          {"top_gas_temperature", heat.top_gas_temperature},
          {"blast", profile.gas_in},
          {"top_gas", profile.gas_out},
          {"walls", profile.to_wall},
          {"residual", profile.residual()},
          {"species", species},
          {"profile", columns}};
}

}  // namespace

nlohmann::json plan_json(const Plan& plan) {
  json result;
  result["campaign"] = plan.campaign;
  for (const PhysicsPiece& piece : plan.physics) {
    result["physics"].push_back(
        {{"name", piece.name}, {"on", piece.on}, {"why", piece.why}, {"core_seconds", piece.core_seconds}});
  }
  const MeshCounts& counts = plan.mesh.counts;
  result["mesh"] = {{"cells", counts.cells()},
                    {"half_width", counts.columns},
                    {"depth", counts.slices_in_all()},
                    {"height", counts.rows_in_all()},
                    {"shortest_edge", plan.mesh.shortest_edge},
                    {"longest_edge", plan.mesh.longest_edge},
                    {"volume", plan.mesh.volume}};
  result["bed"] = {{"volume", plan.bed_volume}, {"stock_line", plan.stock_line}, {"hopper_top", plan.hopper_top}};
  for (std::size_t i = 0; i < plan.species.size(); ++i) {
    const SpeciesPlan& species = plan.species[i];
    result["species"].push_back({{"name", species.name},
                                 {"parcel_diameter", species.parcel_diameter},
                                 {"grains_per_parcel", species.grains_per_parcel},
                                 {"parcels", species.parcels},
                                 {"grains", species.grains()},
                                 {"charge_rate", plan.charge.mass_rate[i]},
                                 {"layer_thickness", plan.charge.layer_thickness[i]}});
  }
  result["charge"] = {{"packing", plan.charge.packing},
                      {"area", plan.charge.area},
                      {"recipe_thickness", plan.charge.recipe_thickness},
                      {"recipe_time", plan.charge.recipe_time},
                      {"dem_speed_up", plan.dem_speed_up}};
  result["inlets"] = json::array();
  for (const InletPlan& inlet : plan.inlets) {
    result["inlets"].push_back({{"name", inlet.name},
                                {"opening", inlet.opening},
                                {"velocity", inlet.state.velocity},
                                {"mach_number", inlet.state.mach_number},
                                {"static_temperature", inlet.state.static_temperature},
                                {"static_pressure", inlet.state.static_pressure}});
  }
  result["pressure"] = plan.pressure ? json{{"at_inlets", plan.pressure->at_inlets},
                                            {"drop", plan.pressure->drop},
                                            {"weight_carried", plan.pressure->weight_carried},
                                            {"most_carried", plan.pressure->most_carried}}
                                     : json(nullptr);
  result["heat"] = plan.heat ? heat_json(plan) : json(nullptr);
  result["dem_time_step"] = {{"step", plan.dem_step.step},
                             {"steps_per_block", plan.dem_step.steps_per_block},
                             {"reference", plan.dem_step.reference},
                             {"reference_name", plan.dem_step.reference_name},
                             {"fraction", plan.dem_step.fraction()}};
  result["cost"] = {{"dem_process_seconds", plan.cost.dem_process_seconds},
                    {"dem_steps", plan.cost.dem_steps},
                    {"dem_core_seconds", plan.cost.dem_core_seconds},
                    {"tracers", plan.cost.tracers},
                    {"tracer_time_step", plan.cost.tracer_time_step},
                    {"tracer_steps", plan.cost.tracer_steps},
                    {"tracer_core_seconds", plan.cost.tracer_core_seconds},
                    {"dem_memory", plan.cost.dem_memory},
                    {"tracer_memory", plan.cost.tracer_memory},
                    {"basis", plan.cost.rates.basis},
                    {"ranks", plan.cost.ranks},
                    {"fewest_episodes", plan.cost.fewest_episodes},
                    {"most_episodes", plan.cost.most_episodes},
                    {"episode_wall_seconds", plan.cost.episode_wall_seconds()},
                    {"longest_stop_seconds", std::chrono::duration<double>(longest_stop).count()},
                    {"dem_block_wall_seconds", plan.cost.dem_block_wall_seconds()},
                    {"tracer_step_wall_seconds", plan.cost.tracer_step_wall_seconds()}};
  result["warnings"] = plan.warnings;
  result["refusals"] = plan.refusals;
  return result;
}

}  // namespace cupola
