#include <fmt/format.h>

#include <cmath>
#include <iterator>

#include "physics/plan/plan.hpp"

namespace cupola {
namespace {

using Text = fmt::memory_buffer;

template <typename... Args>
void line(Text& text, fmt::format_string<Args...> format, Args&&... args) {
  fmt::format_to(std::back_inserter(text), format, std::forward<Args>(args)...);
  text.push_back('\n');
}

std::string duration(double seconds) {
  if (seconds < 120) return fmt::format("{:.3g} s", seconds);
  if (seconds < 7200) return fmt::format("{:.3g} min", seconds / 60);
  return fmt::format("{:.3g} h", seconds / 3600);
}

std::string percent(double share) { return share < 0.001 ? "< 0.1 %" : fmt::format("{:.1f} %", 100 * share); }

std::string megabytes(double bytes) { return fmt::format("{:.2g} MB", std::ceil(bytes / 1e7) * 10); }

void write_physics(Text& text, const Plan& plan) {
  const double all = plan.cost.dem_core_seconds + plan.cost.tracer_core_seconds;
  line(text, "Physics {:>41} of an episode's time", "share");
  for (const PhysicsPiece& piece : plan.physics) {
    const std::string share = piece.core_seconds > 0 && all > 0 ? percent(piece.core_seconds / all) : "";
    line(text, "  {:<3} {:<31} {:>7}  {}", piece.on ? "on" : "off", piece.name, share, piece.why);
  }
}

void write_sizes(Text& text, const Plan& plan) {
  const MeshCounts& counts = plan.mesh.counts;
  line(text, "\nSizes");
  line(text, "  mesh      {} cells: 2 x {} across, {} deep, {} up; edges {:.3g} to {:.3g} m; {:.4g} m3", counts.cells(),
       counts.columns, counts.slices_in_all(), counts.rows_in_all(), plan.mesh.shortest_edge, plan.mesh.longest_edge,
       plan.mesh.volume);
  line(text, "  bed       {:.4g} m3 up to the stock line at {:.4g} m; the DEM domain ends at {:.4g} m", plan.bed_volume,
       plan.stock_line, plan.hopper_top);
  for (const SpeciesPlan& species : plan.species) {
    line(text, "  {:<9} about {:.0f} parcels of {:.3g} m, {:.0f} grains each: {:.3g} grains", species.name,
         species.parcels, species.parcel_diameter, species.grains_per_parcel, species.grains());
  }
}

void write_rates(Text& text, const Plan& plan) {
  line(text, "\nRates (at a packing of {})", plan.charge.packing);
  for (std::size_t i = 0; i < plan.species.size(); ++i) {
    line(text, "  {:<9} {:.3g} kg/s charged, layers of {:.3g} m", plan.species[i].name, plan.charge.mass_rate[i],
         plan.charge.layer_thickness[i]);
  }
  line(text, "  a round of layers passes in {}", duration(plan.charge.recipe_time));
  if (plan.dem_speed_up > 0) {
    line(text, "  the DEM stage runs {:.3g} times faster than the furnace: a round of layers in {}", plan.dem_speed_up,
         duration(plan.charge.recipe_time / plan.dem_speed_up));
  }
}

void write_gas(Text& text, const Plan& plan) {
  if (plan.inlets.empty()) return;
  line(text, "\nGas");
  for (const InletPlan& inlet : plan.inlets) {
    line(text, "  {:<13} {:.4g} m/s, Mach {:.2f}, {:.0f} K static, {:.4g} bar, {:.3g} m2", inlet.name,
         inlet.state.velocity, inlet.state.mach_number, inlet.state.static_temperature,
         inlet.state.static_pressure / 1e5, inlet.opening);
  }
  if (plan.pressure) {
    line(text, "  the bed takes {:.3g} mbar and is carried to {:.1f} % by it ({:.1f} % where most)",
         plan.pressure->drop / 100, 100 * plan.pressure->weight_carried, 100 * plan.pressure->most_carried);
  }
}

void write_heat(Text& text, const Plan& plan) {
  if (!plan.heat) return;
  const HeatBalance& heat = *plan.heat;
  line(text, "\nHeat balance (one-dimensional counter-current bed)");
  line(text, "  heat-capacity flow: solids {:.4g} kW/K, gas {:.4g} kW/K, ratio {:.3f}",
       heat.solids_heat_capacity_flow / 1e3, heat.gas_heat_capacity_flow / 1e3, heat.ratio());
  for (const std::size_t i : heat.kinds) {
    line(text, "  {:<9} {:.3g} transfer units, leaves at {:.0f} K", plan.species[i].name, heat.transfer_units[i],
         heat.leaves_at[i]);
    if (heat.softening_height[i]) line(text, "            softens at {:.2f} m", *heat.softening_height[i]);
    if (heat.melting_height[i]) line(text, "            melts at {:.2f} m", *heat.melting_height[i]);
  }
  line(text, "  top gas {:.0f} K", heat.top_gas_temperature);
  const CounterCurrentSolution& balance = heat.profile;
  line(text, "  of {:.4g} MW blast: top gas {:.1f} %, walls {:.1f} %", balance.gas_in / 1e6,
       100 * balance.gas_out / balance.gas_in, 100 * balance.to_wall / balance.gas_in);
  for (std::size_t k = 0; k < heat.kinds.size(); ++k) {
    line(text, "    {} {:.1f} %", plan.species[heat.kinds[k]].name, 100 * balance.to_solids[k] / balance.gas_in);
  }
}

void write_cost(Text& text, const Plan& plan) {
  const Cost& cost = plan.cost;
  line(text, "\nTime");
  line(text, "  DEM step {:.3g} s, {:.1f} % of the {} of a parcel of {} ({:.3g} s); {} a block", plan.dem_step.step,
       100 * plan.dem_step.fraction(), plan.dem_step.reference_name, plan.dem_step.species, plan.dem_step.reference,
       plan.dem_step.steps_per_block);
  line(text, "  DEM stage: at most {:.3g} s simulated, {:.3g} steps, about {}", cost.dem_process_seconds,
       cost.dem_steps, duration(cost.dem_wall_seconds()));
  line(text, "  tracer stage: {:.3g} tracers, {:.3g} steps of {:.3g} s, about {}", cost.tracers, cost.tracer_steps,
       cost.tracer_time_step, duration(cost.tracer_wall_seconds()));
  line(text, "  an episode takes about {} on {} rank(s), the first longer: its bed has to be filled",
       duration(cost.episode_wall_seconds()), cost.ranks);
  line(text, "  {} to {} episodes: {} to {}", cost.fewest_episodes, cost.most_episodes,
       duration(cost.fewest_episodes * cost.episode_wall_seconds()),
       duration(cost.most_episodes * cost.episode_wall_seconds()));
  line(text,
       "  asked to stop, a DEM stage leaves with a checkpoint after a block at most (about {}), a tracer stage after a "
       "step (about {}); what has not left after {} (--stop-within) is killed and goes on from its last checkpoint",
       duration(cost.dem_block_wall_seconds()), duration(cost.tracer_step_wall_seconds()),
       duration(std::chrono::duration<double>(longest_stop).count()));
  line(text, "  memory over all ranks: DEM stage about {}, tracer stage about {}", megabytes(cost.dem_memory),
       megabytes(cost.tracer_memory));
  line(text, "  (from {:.2g} parcel steps, {:.2g} tracer steps, {:.2g} cells of gas a core second: {})",
       1 / cost.rates.contacts, 1 / cost.rates.motion, 1 / (cost.rates.gas_flow + cost.rates.gas_energy),
       cost.rates.basis);
}

}  // namespace

std::string plan_text(const Plan& plan) {
  Text text;
  line(text, "Campaign {}\n", plan.campaign);
  write_physics(text, plan);
  write_sizes(text, plan);
  write_rates(text, plan);
  write_gas(text, plan);
  write_heat(text, plan);
  write_cost(text, plan);
  if (!plan.warnings.empty()) line(text, "\nWarnings");
  for (const std::string& warning : plan.warnings) line(text, "  {}.", warning);
  if (!plan.refusals.empty()) line(text, "\nThis cannot be run");
  for (const std::string& refusal : plan.refusals) line(text, "  {}.", refusal);
  return fmt::to_string(text);
}

}  // namespace cupola
