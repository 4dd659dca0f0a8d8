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

HeatStep::HeatStep(const Campaign& campaign, const CellSpreading& kernel, const Conduction& conduction,
                   SumOverRanks sum, PartClock& clock)
    : campaign_(campaign),
      kernel_(kernel),
      conduction_(conduction),
      sum_(std::move(sum)),
      clock_(clock),
      exchange_(campaign, kernel) {
  for (const Species& species : campaign.species) {
    constant_capacity_.push_back(
        has_constant_heat_capacity(species) ? species.density * species.heat_capacity.at(enthalpy_zero) : 0);
  }
}

void HeatStep::take_along_paths(const Tracers& tracers, const Stays& stays, BySpecies& taken,
                                BySpecies& taken_temperature) {
  const std::size_t cells = taken.front().size();
  const BySpecies& rate = exchange_.rate();
  approach_.resize(stays.all().size());
  std::vector<double> sums(2 * taken.size() * cells, 0.0);
  const std::size_t half = taken.size() * cells;
  for (std::size_t i = 0; i < tracers.size(); ++i) {
    const std::size_t s = tracers.species[i];
    const std::span<const Stays::Stay> path = stays.of(i);
    double* const approach = approach_.data() + stays.first(i);
    double later = 1;  // what the stays to come leave of a difference
    for (std::size_t j = path.size(); j-- > 0;) {
      const auto c = static_cast<std::size_t>(path[j].cell);
      const double of_stay = -std::expm1(-rate[s][c] * path[j].seconds);
      approach[j] = of_stay * later;
      later *= 1 - of_stay;
      const double volume = tracers.volume[i] * approach[j];
      sums[s * cells + c] += volume;
      sums[half + s * cells + c] += volume * tracers.temperature[i];
    }
  }
  sum_(sums);
  for (std::size_t s = 0; s < taken.size(); ++s) {
    std::copy_n(sums.begin() + static_cast<std::ptrdiff_t>(s * cells), cells, taken[s].begin());
    std::copy_n(sums.begin() + static_cast<std::ptrdiff_t>(half + s * cells), cells, taken_temperature[s].begin());
  }
}

void HeatStep::convect_along_paths(const Tracers& tracers, const Stays& stays, const BySpecies& capacity,
                                   const BySpecies& felt, CellContents& contents) {
  const std::size_t species = capacity.size();
  const std::size_t cells = capacity.front().size();
  std::vector<double> sums(species * cells, 0.0);
  const double inverse_step = 1 / stays.step();
  for (std::size_t i = 0; i < tracers.size(); ++i) {
    const std::size_t s = tracers.species[i];
    const std::span<const Stays::Stay> path = stays.of(i);
    const double* const approach = approach_.data() + stays.first(i);
    const double old = tracers.temperature[i];
    Convected& convected = convected_[i];
    convected = {0, old};
    for (std::size_t j = 0; j < path.size(); ++j) {
      const auto c = static_cast<std::size_t>(path[j].cell);
      const double warmed = approach[j] * (felt[s][c] - old);
      convected.temperature += warmed;
      convected.heat += capacity[s][c] * warmed;
    }
    const double weighted = tracers.volume[i] * inverse_step * convected.temperature;
    for (const Stays::Stay& stay : path)
      sums[s * cells + static_cast<std::size_t>(stay.cell)] += weighted * stay.seconds;
  }
  sum_(sums);
  for (std::size_t s = 0; s < species; ++s) {
    for (std::size_t c = 0; c < cells; ++c) {
      if (contents.volume[s][c] > 0) contents.temperature[s][c] = sums[s * cells + c] / contents.volume[s][c];
    }
  }
}

Conduction::Result HeatStep::conduct(const CellContents& contents, const BySpecies& bed_volume,
                                     const BySpecies& capacity, double step) const {
  const std::size_t species = capacity.size();
  const std::size_t cells = capacity.front().size();
  CellContents around = contents;
  BySpecies spread_capacity = capacity;
  for (std::size_t s = 0; s < species; ++s) {
    for (std::size_t c = 0; c < cells; ++c) {
      spread_capacity[s][c] *= contents.volume[s][c];
      around.temperature[s][c] *= spread_capacity[s][c];
    }
  }
  std::vector<std::vector<double>*> together = pointers(spread_capacity);
  for (BySpecies* const part : {&around.volume, &around.temperature}) {
    for (auto& values : *part) together.push_back(&values);
  }
  kernel_.apply(together);
  for (std::size_t s = 0; s < species; ++s) {
    for (std::size_t c = 0; c < cells; ++c) {
      double& mean = around.temperature[s][c];
      mean = spread_capacity[s][c] > 0 ? mean / spread_capacity[s][c] : 0;
    }
  }
  Conduction::Result conducted = conduction_.advance(around, spread_capacity, bed_volume, step);
  BySpecies& change = conducted.change;
  BySpecies& damping = conducted.damping;
  for (std::size_t s = 0; s < species; ++s) {
    for (std::size_t c = 0; c < cells; ++c) change[s][c] += damping[s][c] * around.temperature[s][c];
  }
  together = pointers(change);
  for (auto& values : damping) together.push_back(&values);
  kernel_.gather(together);
  return conducted;
}

void HeatStep::convect(const Tracers& tracers, const Stays& stays, CellContents& contents, const BedState& bed,
                       GasModel& gas, const BySpecies& capacity) {
  const std::size_t species = capacity.size();
  const std::size_t cells = capacity.front().size();
  auto running = std::make_optional<PartClock::Running>(clock_, "exchange on cells");
  exchange_.set_rates(fields_of(gas, bed), contents);
  largest_biot_ = exchange_.largest_biot();
  running.emplace(clock_, "exchange");
  BySpecies taken(species, std::vector<double>(cells));
  BySpecies taken_temperature = taken;
  take_along_paths(tracers, stays, taken, taken_temperature);
  running.emplace(clock_, "exchange on cells");
  BySpecies conductance = taken;
  BySpecies conductance_temperature = taken_temperature;
  for (std::size_t s = 0; s < species; ++s) {
    for (std::size_t c = 0; c < cells; ++c) {
      conductance[s][c] *= capacity[s][c] / stays.step();
      conductance_temperature[s][c] *= capacity[s][c] / stays.step();
    }
  }
  const SolidsExchange solids = exchange_.seen_by_gas(std::move(conductance), std::move(conductance_temperature));
  running.emplace(clock_, "gas energy");
  gas.solve_energy(bed, solids);
  running.emplace(clock_, "exchange on cells");
  const BySpecies felt = exchange_.felt_temperature(gas.temperature());
  running.emplace(clock_, "exchange");
  convect_along_paths(tracers, stays, capacity, felt, contents);
}

double HeatStep::advance(Tracers& tracers, const Stays& stays, CellContents& contents, const BySpecies& bed_volume,
                         const BedState& bed, GasModel* gas, Leaving& leaving) {
  const std::size_t species = contents.volume.size();
  const std::size_t cells = contents.volume.front().size();
  const BySpecies before = contents.temperature;
  // Heat capacities as at the beginning of the step: the same for gas, neighbours and tracers.
  BySpecies capacity(species);
  for (std::size_t s = 0; s < species; ++s)
    capacity[s] = volumetric_heat_capacity(campaign_.species[s], contents.temperature[s]);
  convected_.resize(tracers.size());
  if (gas != nullptr) {
    convect(tracers, stays, contents, bed, *gas, capacity);
  } else {
    for (std::size_t i = 0; i < tracers.size(); ++i) convected_[i] = {0, tracers.temperature[i]};
  }
  auto running = std::make_optional<PartClock::Running>(clock_, "conduction");
  const auto [change, damping, walls, iterations] = conduct(contents, bed_volume, capacity, stays.step());
  for (std::size_t s = 0; s < species; ++s) {
    for (std::size_t c = 0; c < cells; ++c) {
      double& mean = contents.temperature[s][c];
      if (contents.volume[s][c] > 0) mean = 0.5 * (before[s][c] + mean + change[s][c] - damping[s][c] * mean);
    }
  }
  running.emplace(clock_, "exchange");
  const double inverse_step = 1 / stays.step();
  for (std::size_t i = 0; i < tracers.size(); ++i) {
    const std::size_t s = tracers.species[i];
    const Species& material = campaign_.species[s];
    double& temperature = tracers.temperature[i];
    const double old = temperature;
    double heat = convected_[i].heat;  // J/m3, at the capacities of the cells; that of the tracer itself may differ
    for (const Stays::Stay& stay : stays.of(i)) {
      const auto c = static_cast<std::size_t>(stay.cell);
      heat += capacity[s][c] * stay.seconds * inverse_step * (change[s][c] - damping[s][c] * convected_[i].temperature);
    }
    if (constant_capacity_[s] > 0) {
      temperature += heat / constant_capacity_[s];
    } else {
      temperature = solid_temperature(material, solid_enthalpy(material, old) + heat / material.density);
    }
    if (!(temperature > 0 && temperature < 1e5)) {
      throw Failure(
          ExitCode::diverged,
          fmt::format("the temperature of tracer {} became {} K; shorten tracer.time_step", tracers.id[i], temperature))
          .at("tracer", std::to_string(tracers.id[i]))
          .at("cell", std::to_string(tracers.point[i].cell))
          .advise("tracer.time_step", fmt::format("{:.6g}", stays.step() / 2));
    }
    // The end of a step that is nearest to when it melts: early as often as late.
    const double next = temperature + std::max(0.0, 0.5 * (temperature - old));
    if (material.softening && next >= material.softening->melted && !leaving[i]) leaving[i] = Cause::melted;
  }
  return walls;
}

double HeatStep::relaxation_time(const CellContents& contents) const {
  double capacity = 0;
  double conductance = 0;
  const BySpecies& rate = exchange_.rate();
  for (std::size_t s = 0; s < rate.size(); ++s) {
    const Species& species = campaign_.species[s];
    for (std::size_t c = 0; c < rate[s].size(); ++c) {
      const double here =
          species.density * species.heat_capacity.at(contents.temperature[s][c]) * contents.volume[s][c];
      capacity += here;
      conductance += here * rate[s][c];
    }
  }
  return conductance > 0 ? capacity / conductance : std::numeric_limits<double>::infinity();
}

SolidsExchange HeatStep::solids_at_rest(const CellContents& contents, const BedState& bed, const GasModel& gas) {
  exchange_.set_rates(fields_of(gas, bed), contents);
  return exchange_.solids(contents, 0);
}

double HeatStep::settle_stagnant(Tracers& tracers, const CellContents& contents, const BySpecies& bed_volume,
                                 const std::vector<bool>& stagnant, const BedState& bed, const GasModel& gas) const {
  const CellContents spread_contents = spread(contents, kernel_);
  Exchange at_rest(campaign_, kernel_);
  at_rest.set_rates(fields_of(gas, bed), contents);
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

}  // namespace cupola
