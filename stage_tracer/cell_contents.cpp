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
