#include "stage_tracer/stays.hpp"

#include <algorithm>

namespace cupola {

Stays::Stays(const Tracers& tracers, double step) : step_(step) {
  stays_.reserve(tracers.size());
  end_.reserve(tracers.size());
  for (const PathField::Point& point : tracers.point) {
    stays_.push_back({static_cast<std::int32_t>(point.cell), step});
    next_tracer();
  }
}

CellContents sum_stays(const Tracers& tracers, const Stays& stays, std::size_t species, std::size_t cells, bool heat,
                       const SumOverRanks& sum) {
  // One flat array, so that the ranks exchange one message: volumes, then volume x temperature.
  std::vector<double> sums((heat ? 2 : 1) * species * cells + 1, 0.0);
  const std::size_t half = species * cells;
  const double inverse_step = 1 / stays.step();
  for (std::size_t i = 0; i < tracers.size(); ++i) {
    const std::size_t first_place = tracers.species[i] * cells;
    for (const Stays::Stay& stay : stays.of(i)) {
      const std::size_t place = first_place + static_cast<std::size_t>(stay.cell);
      const double volume = tracers.volume[i] * stay.seconds * inverse_step;
      sums[place] += volume;
      if (heat) sums[half + place] += volume * tracers.temperature[i];
    }
  }
  sum(sums);
  CellContents contents;
  for (std::size_t s = 0; s < species; ++s) {
    const auto begin = sums.begin() + static_cast<std::ptrdiff_t>(s * cells);
    contents.volume.emplace_back(begin, begin + static_cast<std::ptrdiff_t>(cells));
    if (!heat) continue;
    std::vector<double> mean(cells, 0.0);
    for (std::size_t c = 0; c < cells; ++c) {
      if (contents.volume[s][c] > 0) mean[c] = sums[half + s * cells + c] / contents.volume[s][c];
    }
    contents.temperature.push_back(std::move(mean));
  }
  return contents;
}

CellContents sum_tracers(const Tracers& tracers, std::size_t species, std::size_t cells, bool heat,
                         const SumOverRanks& sum) {
  return sum_stays(tracers, Stays(tracers, 1), species, cells, heat, sum);
}

void remove_leaving(Tracers& tracers, const Leaving& leaving, const Campaign& campaign, Tally& tally) {
  std::vector<std::uint8_t> drop(tracers.size(), 0);
  bool any = false;
  for (std::size_t i = 0; i < tracers.size(); ++i) {
    if (!leaving[i]) continue;
    const Species& species = campaign.species[tracers.species[i]];
    tally.leave(*leaving[i], tracers.volume[i] * species.density,
                campaign.heat ? enthalpy(species, tracers.volume[i], tracers.temperature[i]) : 0);
    drop[i] = 1;
    any = true;
  }
  if (any) tracers.remove(drop);
}

}  // namespace cupola
