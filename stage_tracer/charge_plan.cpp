#include "stage_tracer/charge_plan.hpp"

#include <algorithm>
#include <cmath>

#include "schemas/failure.hpp"

namespace cupola {

ChargePlan::ChargePlan(const Campaign& campaign, double solids_volume_rate, double position)
    : rate_(solids_volume_rate), position_(position) {
  double volume = 0;
  for (const Layer& layer : campaign.charging.layers) {
    std::vector<double> share(campaign.species.size(), 0.0);
    double layer_volume = 0;
    for (const auto& [name, mass] : layer) {
      const std::size_t s = campaign.species_index(name);
      share[s] = mass / campaign.species[s].density;
      layer_volume += share[s];
    }
    if (!(layer_volume > 0)) {
      throw Failure(ExitCode::wrong_input, "a layer of charging.layers holds no mass; give each layer a positive mass");
    }
    for (double& s : share) s /= layer_volume;
    volume += layer_volume;
    share_.push_back(std::move(share));
    end_.push_back(volume);
  }
  if (end_.empty()) {
    throw Failure(ExitCode::wrong_input,
                  "charging.layers is empty; the tracer stage needs at least one layer to charge");
  }
  position_ = std::fmod(position_, volume);
  if (position_ < 0) position_ += volume;
}

std::vector<ChargePlan::Piece> ChargePlan::pieces(double from, double to) const {
  std::vector<Piece> result;
  const double cycle = cycle_volume();
  double time = from;
  const double passed = position_ + rate_ * from;
  double turn = std::floor(passed / cycle);
  const double in_cycle = passed - turn * cycle;
  std::size_t layer = 0;
  while (layer + 1 < end_.size() && in_cycle >= end_[layer]) ++layer;
  while (time < to) {
    const double layer_ends = (turn * cycle + end_[layer] - position_) / rate_;
    const double until = std::min(to, layer_ends);
    if (until > time) {
      result.push_back({time, until, layer, &share_[layer]});
      time = until;
    }
    if (++layer == end_.size()) {
      layer = 0;
      turn += 1;
    }
  }
  return result;
}

double ChargePlan::thinnest_layer_seconds() const {
  double thinnest = end_.front();
  for (std::size_t layer = 1; layer < end_.size(); ++layer)
    thinnest = std::min(thinnest, end_[layer] - end_[layer - 1]);
  return thinnest / rate_;
}

}  // namespace cupola
