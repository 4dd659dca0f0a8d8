#include "stage_tracer/motion.hpp"

namespace cupola {
namespace {

/// A tracer's life runs down along its path.
struct LifeClock {
  const std::vector<double>* removal_rate;
  double life;
};

void pass_cell(void* context, std::int64_t cell, double seconds) {
  auto* clock = static_cast<LifeClock*>(context);
  clock->life -= seconds * (*clock->removal_rate)[cell];
}

}  // namespace

void Motion::advance(Tracers& tracers, double from, double to, const std::vector<Entry>& entries, std::uint64_t seed,
                     Tally& tally) const {
  const bool heat = campaign_.heat.has_value();
  const std::size_t old = tracers.size();
  for (const Entry& entry : entries) {
    tracers.add(entry.id, entry.species, entry.point, entry.volume, draw_life(seed, entry.id));
    const Species& species = campaign_.species[entry.species];
    if (heat) tracers.temperature.push_back(campaign_.charging.temperature);
    tally.enter(entry.volume * species.density,
                heat ? enthalpy(species, entry.volume, campaign_.charging.temperature) : 0);
  }
  std::vector<std::uint8_t> drop(tracers.size(), 0);
  bool any = false;
  for (std::size_t i = 0; i < tracers.size(); ++i) {
    PathField::Point& point = tracers.point[i];
    if (field_.stagnant[point.cell]) continue;
    const double seconds = i < old ? to - from : to - entries[i - old].time;
    LifeClock clock{&field_.removal_rate, tracers.life[i]};
    const PathField::End end = paths_.advance(point, seconds, &pass_cell, &clock);
    tracers.life[i] = clock.life;
    const Species& species = campaign_.species[tracers.species[i]];
    const bool too_low = species.softening && paths_.position(point)[2] < species.none_below;
    const bool gone = end == PathField::End::left_through_outflow || !field_.bed[point.cell];
    if (clock.life > 0 && !too_low && !gone) continue;
    const Cause cause = clock.life <= 0 ? Cause::raceway : (too_low ? Cause::unmelted : Cause::lost);
    tally.leave(cause, tracers.volume[i] * species.density,
                heat ? enthalpy(species, tracers.volume[i], tracers.temperature[i]) : 0);
    drop[i] = 1;
    any = true;
  }
  if (any) tracers.remove(drop);
}

}  // namespace cupola
