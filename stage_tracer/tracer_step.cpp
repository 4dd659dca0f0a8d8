#include <algorithm>
#include <cmath>
#include <string>

#include "stage_tracer/displacement.hpp"
#include "stage_tracer/tracer_stage.hpp"

/// One step of the march.
namespace cupola {
namespace {

constexpr long steps_between_sorting = 5;

}  // namespace

void TracerStage::step() {
  advance(steps_.length);
  if (++step_ == steps_.count) now_ = campaign_.tracer.longest();
  close_balances();
}

void TracerStage::advance(double seconds) {
  if (step_ % steps_between_sorting == 0) tracers_.sort_by_cell(mesh_.cells());
  if (campaign_.tracer.displacement != TracerSettings::Displacement::none) displace_tracers(seconds);
  Motion::Moved moved = move(seconds);
  compose(moved.stays);
  if (gas_) {
    const auto running = clock_.measure("flow");
    gas_->follow(bed_);
  }
  if (campaign_.heat) exchange_heat(moved);
  average(seconds);
  remove_leaving(tracers_, moved.leaving, campaign_, local_tally_);
  now_ += seconds;
}

void TracerStage::displace_tracers(double seconds) {
  const TracerSettings& settings = campaign_.tracer;
  const bool random = settings.displacement != TracerSettings::Displacement::relaxation;
  const bool relaxes = settings.displacement != TracerSettings::Displacement::random;
  contents_ = sum_tracers(tracers_, campaign_.species.size(), mesh_.cells(), false, sum_);
  std::vector<double> packed(mesh_.cells(), 0.0);
  for (const auto& volume : contents_.volume) {
    for (std::size_t c = 0; c < packed.size(); ++c) packed[c] += volume[c];
  }
  const std::vector<double> excess = random ? volume_excess(mesh_, displaced_, packed, field_.solids_fraction)
                                            : std::vector<double>(mesh_.cells(), 0.0);
  held_back_ += displace(tracers_, settings, locator_, paths_, field_.bed, excess, seconds, task_.random_seed, step_,
                         relaxes ? relaxation(mesh_, displaced_, packed, field_.solids_fraction, settings, seconds)
                                 : std::vector<Vector3>{});
}

Motion::Moved TracerStage::move(double seconds) {
  const auto running = clock_.measure("motion");
  const double to = now_ + seconds;
  std::vector<Entry> entries = insertion_ ? insertion_->advance(now_, to) : std::vector<Entry>{};
  std::erase_if(entries, [&](const Entry& entry) { return rank_of(entry.id, foam_.ranks()) != foam_.rank(); });
  return motion_.advance(tracers_, now_, to, entries, task_.random_seed, local_tally_);
}

void TracerStage::compose(const Stays& stays) {
  const auto running = clock_.measure("projection");
  contents_ = sum_stays(tracers_, stays, campaign_.species.size(), mesh_.cells(), campaign_.heat.has_value(), sum_);
  bed_volume_ = bed_composition(mesh_, campaign_, field_, spread(contents_, kernel_), empty_share_);
  bed_ = bed_state(mesh_, campaign_, bed_volume_);
  cells_at_floor_ = std::max(cells_at_floor_, bed_.cells_at_floor);
}

void TracerStage::exchange_heat(Motion::Moved& moved) {
  ledger_.walls += heat_.advance(tracers_, moved.stays, contents_, bed_volume_, bed_, gas_.get(), moved.leaving);
  if (!gas_) return;
  const double seconds = moved.stays.step();
  const GasEnergy::Ledger& gas = gas_->energy_ledger();
  ledger_.blast += gas.blast * seconds;
  ledger_.top_gas += gas.top_gas * seconds;
  ledger_.walls += gas.walls * seconds;
  ledger_.to_solids += gas.to_solids * seconds;
}

double TracerStage::window() const { return charge_ ? charge_->cycle_seconds() : 0.1 * campaign_.tracer.longest(); }

void TracerStage::average(double seconds) {
  const bool until_steady = campaign_.tracer.stop == TracerSettings::Stop::steady;
  const double middle = now_ + 0.5 * seconds;
  if (!until_steady && !windows_ && middle < campaign_.tracer.duration - window() && step_ + 1 < steps_.count) return;
  const auto running = clock_.measure("averages");
  averages_.add(spread(contents_, kernel_), campaign_, seconds);
}

void TracerStage::close_balances() {
  const auto running = clock_.measure("balances");
  std::vector<double> row = local_tally_.row();
  double mass = 0;
  double energy = 0;
  for (std::size_t i = 0; i < tracers_.size(); ++i) {
    const Species& species = campaign_.species[tracers_.species[i]];
    mass += tracers_.volume[i] * species.density;
    if (campaign_.heat) energy += enthalpy(species, tracers_.volume[i], tracers_.temperature[i]);
  }
  row.insert(row.end(), {mass, energy, static_cast<double>(tracers_.size())});
  sum_(row);
  all_tracers_ = static_cast<std::size_t>(row.back());
  ledger_.mass_now = row[Tally::columns];
  ledger_.energy_now = row[Tally::columns + 1];
  ledger_.tally += Tally::from_row(row);
  local_tally_ = Tally{};
  if (all_tracers_ == 0) {
    throw Failure(ExitCode::diverged, "no tracer is left in the bed; check raceways and melting against the charge")
        .at("step", std::to_string(step_));
  }
}

}  // namespace cupola
