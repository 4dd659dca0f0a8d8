#include "stage_tracer/heat_step.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

#include "physics/closures/solid_enthalpy.hpp"
#include "schemas/failure.hpp"

namespace cupola {

namespace {

Exchange::GasFields fields_of(const GasModel& gas, const BedState& bed) {
  return {gas.flow().mass_flux(), gas.temperature(), bed.void_fraction};
}

}  // namespace

double HeatStep::advance(Tracers& tracers, CellContents& contents, const BySpecies& bed_volume, const BedState& bed,
                         GasModel* gas, double step) {
  const std::size_t species = contents.volume.size();
  const std::size_t cells = contents.volume.front().size();
  // Heat capacities as at the beginning of the step: the same for gas, neighbours and tracers.
  BySpecies capacity(species);
  BySpecies spread_capacity(species);
  for (std::size_t s = 0; s < species; ++s) {
    capacity[s] = volumetric_heat_capacity(campaign_.species[s], contents.temperature[s]);
    spread_capacity[s] = capacity[s];
    for (std::size_t c = 0; c < cells; ++c) spread_capacity[s][c] *= contents.volume[s][c];
  }
  kernel_.apply(pointers(spread_capacity));
  BySpecies felt(species, std::vector<double>(cells, 0.0));
  BySpecies decay(species, std::vector<double>(cells, 1.0));
  if (gas != nullptr) {
    auto running = std::make_optional<PartClock::Running>(clock_, "exchange on cells");
    exchange_.set_rates(fields_of(*gas, bed), contents, step);
    largest_biot_ = exchange_.largest_biot();
    const SolidsExchange solids = exchange_.solids(contents);
    running.emplace(clock_, "gas energy");
    gas->solve_energy(bed, solids);
    running.emplace(clock_, "exchange on cells");
    felt = exchange_.felt_temperature(gas->temperature());
    decay = exchange_.decay();
  }
  auto running = std::make_optional<PartClock::Running>(clock_, "conduction");
  for (std::size_t s = 0; s < species; ++s) {
    for (std::size_t c = 0; c < cells; ++c) {
      if (contents.volume[s][c] > 0)
        contents.temperature[s][c] = felt[s][c] + (contents.temperature[s][c] - felt[s][c]) * decay[s][c];
    }
  }
  Conduction::Result conducted = conduction_.advance(spread(contents, kernel_), spread_capacity, bed_volume, step);
  BySpecies& shift = conducted.change;
  kernel_.gather(pointers(shift));
  for (std::size_t s = 0; s < species; ++s) {
    for (std::size_t c = 0; c < cells; ++c) {
      if (contents.volume[s][c] > 0) contents.temperature[s][c] += shift[s][c];
    }
  }
  running.emplace(clock_, "exchange");
  for (std::size_t i = 0; i < tracers.size(); ++i) {
    const std::size_t s = tracers.species[i];
    const auto c = static_cast<std::size_t>(tracers.point[i].cell);
    const Species& material = campaign_.species[s];
    double& temperature = tracers.temperature[i];
    // At the capacity of the step; that of the tracer itself may differ.
    const double rise = (felt[s][c] - temperature) * (1 - decay[s][c]) + shift[s][c];
    if (has_constant_heat_capacity(material)) {
      temperature += rise;
    } else {
      temperature =
          solid_temperature(material, solid_enthalpy(material, temperature) + capacity[s][c] / material.density * rise);
    }
    if (!(temperature > 0 && temperature < 1e5)) {
      throw Failure(
          ExitCode::diverged,
          fmt::format("the temperature of tracer {} became {} K; shorten tracer.time_step", tracers.id[i], temperature))
          .at("tracer", std::to_string(tracers.id[i]))
          .at("cell", std::to_string(c))
          .advise("tracer.time_step", fmt::format("{:.6g}", step / 2));
    }
  }
  return conducted.walls;
}

double HeatStep::relaxation_time(const CellContents& contents, double step) const {
  double capacity = 0;
  double conductance = 0;
  const BySpecies& decay = exchange_.decay();
  for (std::size_t s = 0; s < decay.size(); ++s) {
    const Species& species = campaign_.species[s];
    for (std::size_t c = 0; c < decay[s].size(); ++c) {
      const double here =
          species.density * species.heat_capacity.at(contents.temperature[s][c]) * contents.volume[s][c];
      capacity += here;
      conductance -= here * std::log(std::max(decay[s][c], 1e-300)) / step;
    }
  }
  return conductance > 0 ? capacity / conductance : std::numeric_limits<double>::infinity();
}

SolidsExchange HeatStep::solids_at_rest(const CellContents& contents, const BedState& bed, const GasModel& gas) {
  exchange_.set_rates(fields_of(gas, bed), contents, 0);
  return exchange_.solids(contents);
}

double HeatStep::settle_stagnant(Tracers& tracers, const CellContents& contents, const BySpecies& bed_volume,
                                 const std::vector<bool>& stagnant, const BedState& bed, const GasModel& gas) const {
  const CellContents spread_contents = spread(contents, kernel_);
  Exchange at_rest(campaign_, kernel_);
  at_rest.set_rates(fields_of(gas, bed), contents, 0);
  BySpecies conductance;
  for (std::size_t s = 0; s < spread_contents.volume.size(); ++s) {
    conductance.push_back(at_rest.coefficient()[s]);
    for (std::size_t c = 0; c < conductance[s].size(); ++c) {
      conductance[s][c] *= 6 * spread_contents.volume[s][c] / campaign_.species[s].diameter;
    }
  }
  const BySpecies gas_temperature(conductance.size(), gas.temperature());
  const BySpecies steady = conduction_.steady(spread_contents, bed_volume, stagnant, conductance, gas_temperature);
  double largest = 0;
  for (std::size_t i = 0; i < tracers.size(); ++i) {
    const auto c = static_cast<std::size_t>(tracers.point[i].cell);
    if (!stagnant[c]) continue;
    const double target = steady[tracers.species[i]][c];
    largest = std::max(largest, std::abs(target - tracers.temperature[i]));
    tracers.temperature[i] = target;
  }
  return largest;
}

void remove_molten(Tracers& tracers, const Campaign& campaign, Tally& tally) {
  std::vector<std::uint8_t> drop(tracers.size(), 0);
  bool any = false;
  for (std::size_t i = 0; i < tracers.size(); ++i) {
    const Species& species = campaign.species[tracers.species[i]];
    if (!species.softening || tracers.temperature[i] < species.softening->melted) continue;
    tally.leave(Cause::melted, tracers.volume[i] * species.density,
                enthalpy(species, tracers.volume[i], tracers.temperature[i]));
    drop[i] = 1;
    any = true;
  }
  if (any) tracers.remove(drop);
}

}  // namespace cupola
