#include "stage_tracer/motion.hpp"

#include <algorithm>
#include <limits>

namespace cupola {
namespace {

enum Mark : std::uint8_t { in_bed = 1, stands_still = 2, reaches_too_low = 4, removes = 8 };

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
                                          (low ? reaches_too_low : 0) | (field.removal_rate[c] > 0 ? removes : 0));
  }
}

bool Motion::live(double& life, std::vector<PathField::Stay>& stays, std::size_t first) const {
  for (std::size_t j = first; j < stays.size(); ++j) {
    const auto cell = static_cast<std::size_t>(stays[j].cell);
    if ((marks_[cell] & removes) == 0) continue;
    const double used_up = stays[j].seconds * field_.removal_rate[cell];
    if (used_up >= life) {
      stays[j].seconds *= life / used_up;
      stays.resize(j + 1);
      return true;
    }
    life -= used_up;
  }
  return false;
}

Motion::Moved Motion::advance(Tracers& tracers, double from, double to, const std::vector<Entry>& entries,
                              std::uint64_t seed, Tally& tally) const {
  const bool heat = campaign_.heat.has_value();
  const std::size_t old = tracers.size();
  for (const Entry& entry : entries) {
    tracers.add(entry.id, entry.species, entry.point, entry.volume, draw_life(seed, entry.id));
    const Species& species = campaign_.species[entry.species];
    if (heat) tracers.temperature.push_back(campaign_.charging.temperature);
    tally.enter(entry.volume * species.density,
                heat ? enthalpy(species, entry.volume, campaign_.charging.temperature) : 0);
  }
  Moved moved{Stays(to - from), Leaving(tracers.size())};
  std::vector<PathField::Stay>& stays = moved.stays.open();
  stays.reserve(2 * tracers.size());
  for (std::size_t i = 0; i < tracers.size(); ++i) {
    PathField::Point& point = tracers.point[i];
    const std::size_t first = stays.size();
    const double seconds = i < old ? to - from : to - entries[i - old].time;
    if ((marks_[static_cast<std::size_t>(point.cell)] & stands_still) != 0) {
      stays.push_back({static_cast<std::int32_t>(point.cell), seconds});
      moved.stays.next_tracer();
      continue;
    }
    const PathField::End end = paths_.advance(point, seconds, stays);
    const bool used_up = live(tracers.life[i], stays, first);
    moved.stays.next_tracer();
    const std::uint8_t mark = marks_[static_cast<std::size_t>(point.cell)];
    const Species& species = campaign_.species[tracers.species[i]];
    const bool too_low =
        (mark & reaches_too_low) != 0 && species.softening && paths_.position(point)[2] < species.none_below;
    if (used_up) {
      moved.leaving[i] = Cause::raceway;
    } else if (too_low) {
      moved.leaving[i] = Cause::unmelted;
    } else if (end == PathField::End::left_through_outflow || (mark & in_bed) == 0) {
      moved.leaving[i] = Cause::lost;
    }
  }
  return moved;
}

}  // namespace cupola
