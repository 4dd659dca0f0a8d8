#include "stage_tracer/averages.hpp"

#include <algorithm>

namespace cupola {

double mean_temperature(const CellContents& contents, const Campaign& campaign) {
  double capacity = 0;
  double heat = 0;
  for (std::size_t s = 0; s < contents.volume.size(); ++s) {
    const Species& species = campaign.species[s];
    for (std::size_t c = 0; c < contents.volume[s].size(); ++c) {
      const double temperature = contents.temperature[s][c];
      const double here = species.density * species.heat_capacity.at(temperature) * contents.volume[s][c];
      capacity += here;
      heat += here * temperature;
    }
  }
  return capacity > 0 ? heat / capacity : 0;
}

Averages::Averages(std::size_t species, std::size_t cells, bool heat)
    : species_(species),
      cells_(cells),
      heat_(heat),
      volume_(species * cells, 0.0),
      volume_temperature_(heat ? species * cells : 0, 0.0) {}

void Averages::add(const CellContents& contents, const Campaign& campaign, double seconds) {
  seconds_ += seconds;
  if (heat_) mean_ += seconds * mean_temperature(contents, campaign);
  for (std::size_t s = 0; s < species_; ++s) {
    for (std::size_t c = 0; c < cells_; ++c) {
      const double weight = seconds * contents.volume[s][c];
      volume_[s * cells_ + c] += weight;
      if (heat_) volume_temperature_[s * cells_ + c] += weight * contents.temperature[s][c];
    }
  }
}

BySpecies Averages::volume() const {
  BySpecies result(species_, std::vector<double>(cells_, 0.0));
  if (seconds_ <= 0) return result;
  for (std::size_t i = 0; i < volume_.size(); ++i) result[i / cells_][i % cells_] = volume_[i] / seconds_;
  return result;
}

BySpecies Averages::temperature() const {
  BySpecies result(heat_ ? species_ : 0, std::vector<double>(cells_, 0.0));
  for (std::size_t i = 0; i < volume_temperature_.size(); ++i) {
    if (volume_[i] > 0) result[i / cells_][i % cells_] = volume_temperature_[i] / volume_[i];
  }
  return result;
}

std::pair<std::vector<double>, std::vector<double>> Averages::solids(const Campaign& campaign) const {
  std::vector<double> capacity(cells_, 0.0);
  std::vector<double> temperature(cells_, 0.0);
  if (!heat_ || seconds_ <= 0) return {capacity, temperature};
  for (std::size_t i = 0; i < volume_.size(); ++i) {
    if (!(volume_[i] > 0)) continue;
    const Species& species = campaign.species[i / cells_];
    const double mean = volume_temperature_[i] / volume_[i];
    const double here = species.density * species.heat_capacity.at(mean) * volume_[i] / seconds_;
    capacity[i % cells_] += here;
    temperature[i % cells_] += here * mean;
  }
  for (std::size_t c = 0; c < cells_; ++c) {
    if (capacity[c] > 0) temperature[c] /= capacity[c];
  }
  return {capacity, temperature};
}

void Averages::clear() { *this = Averages(species_, cells_, heat_); }

std::vector<double> Averages::row() const {
  std::vector<double> result = {seconds_, mean_};
  result.insert(result.end(), volume_.begin(), volume_.end());
  result.insert(result.end(), volume_temperature_.begin(), volume_temperature_.end());
  return result;
}

void Averages::restore(const std::vector<double>& row) {
  seconds_ = row.at(0);
  mean_ = row.at(1);
  const auto begin = row.begin() + 2;
  const auto middle = begin + static_cast<std::ptrdiff_t>(volume_.size());
  std::copy(begin, middle, volume_.begin());
  std::copy(middle, row.end(), volume_temperature_.begin());
}

}  // namespace cupola
