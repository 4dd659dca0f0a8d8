#include "stage_tracer/motion.hpp"

#include <algorithm>
#include <limits>

namespace cupola {
namespace {

enum Mark : std::uint8_t { in_bed = 1, stands_still = 2, reaches_too_low = 4 };

}  // namespace

Motion::Motion(const Campaign& campaign, const GranularField& field, const PathField& paths)
    : campaign_(campaign),
      field_(field),
      paths_(paths),
      none_below_(-std::numeric_limits<double>::infinity()),
      marks_(field.bed.size()) {
  for (const Species& species : campaign.species) {
    if (species.softening) none_below_ = std::max(none_below_, species.none_below);
  }
  for (std::size_t c = 0; c < marks_.size(); ++c) {
    const bool low = paths.lowest(static_cast<std::int64_t>(c)) < none_below_;
    marks_[c] = static_cast<std::uint8_t>((field.bed[c] ? in_bed : 0) | (field.stagnant[c] ? stands_still : 0) |
                                          (low ? reaches_too_low : 0));
  }
}

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
    if ((marks_[static_cast<std::size_t>(point.cell)] & stands_still) != 0) continue;
    const double seconds = i < old ? to - from : to - entries[i - old].time;
    double used_up = 0;
    const PathField::End end = paths_.advance(point, seconds, field_.removal_rate, used_up);
    tracers.life[i] -= used_up;
    const std::uint8_t mark = marks_[static_cast<std::size_t>(point.cell)];
    const Species& species = campaign_.species[tracers.species[i]];
    const bool too_low =
        (mark & reaches_too_low) != 0 && species.softening && paths_.position(point)[2] < species.none_below;
    const bool gone = end == PathField::End::left_through_outflow || (mark & in_bed) == 0;
    if (tracers.life[i] > 0 && !too_low && !gone) continue;
    const Cause cause = tracers.life[i] <= 0 ? Cause::raceway : (too_low ? Cause::unmelted : Cause::lost);
    tally.leave(cause, tracers.volume[i] * species.density,
                heat ? enthalpy(species, tracers.volume[i], tracers.temperature[i]) : 0);
    drop[i] = 1;
    any = true;
  }
  if (any) tracers.remove(drop);
}

}  // namespace cupola
