#include "stage_tracer/cell_contents.hpp"

namespace cupola {

std::vector<std::vector<double>*> pointers(BySpecies& arrays) {
  std::vector<std::vector<double>*> result;
  for (auto& array : arrays) result.push_back(&array);
  return result;
}

double kernel_diameter(const Campaign& campaign, const Charge& charge) {
  double diameter = 0;
  double share = 0;
  for (std::size_t s = 0; s < campaign.species.size(); ++s) {
    diameter += charge.volume_share[s] * campaign.species[s].parcel_diameter();
    share += charge.volume_share[s];
  }
  return share > 0 ? diameter / share : campaign.species.front().parcel_diameter();
}

CellContents sum_tracers(const Tracers& tracers, std::size_t species, std::size_t cells, bool heat,
                         const SumOverRanks& sum) {
  // One flat array, so that the ranks exchange one message: volumes, then volume x temperature.
  std::vector<double> sums((heat ? 2 : 1) * species * cells + 1, 0.0);
  const std::size_t half = species * cells;
  for (std::size_t i = 0; i < tracers.size(); ++i) {
    const std::size_t place = tracers.species[i] * cells + static_cast<std::size_t>(tracers.point[i].cell);
    sums[place] += tracers.volume[i];
    if (heat) sums[half + place] += tracers.volume[i] * tracers.temperature[i];
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

CellContents spread(const CellContents& contents, const CellSpreading& kernel) {
  CellContents result = contents;
  std::vector<std::vector<double>*> sums = pointers(result.volume);
  for (std::size_t s = 0; s < result.temperature.size(); ++s) {
    std::vector<double>& mean = result.temperature[s];
    for (std::size_t c = 0; c < mean.size(); ++c) mean[c] *= contents.volume[s][c];
    sums.push_back(&mean);
  }
  kernel.apply(sums);
  for (std::size_t s = 0; s < result.temperature.size(); ++s) {
    std::vector<double>& mean = result.temperature[s];
    for (std::size_t c = 0; c < mean.size(); ++c) mean[c] = result.volume[s][c] > 0 ? mean[c] / result.volume[s][c] : 0;
  }
  return result;
}

BySpecies volume_shares(const CellContents& spread_contents, const std::vector<double>& empty_share) {
  BySpecies share = spread_contents.volume;
  if (share.empty()) return share;
  for (std::size_t c = 0; c < share[0].size(); ++c) {
    double total = 0;
    for (const auto& volume : share) total += volume[c];
    for (std::size_t s = 0; s < share.size(); ++s) share[s][c] = total > 0 ? share[s][c] / total : empty_share[s];
  }
  return share;
}

}  // namespace cupola
