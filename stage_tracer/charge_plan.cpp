#include "stage_tracer/charge_plan.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>

#include "schemas/failure.hpp"

namespace cupola {
namespace {

using Matrix = std::vector<std::vector<double>>;  // zones x layers

/// Scales rows and columns in turn until rows sum to `row` and columns to `column`: of all such matrices the one
/// nearest to `start` (relative entropy).
Matrix fit(Matrix start, const std::vector<double>& row, const std::vector<double>& column) {
  constexpr int most_turns = 10000;
  constexpr double tolerance = 1e-12;
  double worst = 0;
  std::size_t worst_layer = 0;
  for (int turn = 0; turn < most_turns; ++turn) {
    for (std::size_t l = 0; l < column.size(); ++l) {
      double sum = 0;
      for (const auto& zone : start) sum += zone[l];
      for (auto& zone : start) zone[l] *= column[l] / sum;
    }
    for (std::size_t z = 0; z < row.size(); ++z) {
      double sum = 0;
      for (const double entry : start[z]) sum += entry;
      if (sum > 0) {
        for (double& entry : start[z]) entry *= row[z] / sum;
      }
    }
    worst = 0;
    for (std::size_t l = 0; l < column.size(); ++l) {
      double sum = 0;
      for (const auto& zone : start) sum += zone[l];
      const double error = std::abs(sum / column[l] - 1);
      if (error > worst) {
        worst = error;
        worst_layer = l;
      }
    }
    if (worst < tolerance) return start;
  }
  throw Failure(ExitCode::wrong_input,
                fmt::format("charging.layers[{}].ring: the bed below the ring does not descend fast enough to take the "
                            "layer's mass, {:.3g} of it is left over; widen the ring or charge less in it",
                            worst_layer, worst))
      .at("key", fmt::format("charging.layers[{}].ring", worst_layer));
}

}  // namespace

ChargePlan::ChargePlan(const Campaign& campaign, double solids_volume_rate, double position,
                       const std::vector<Place>& places)
    : rate_(solids_volume_rate), position_(position) {
  std::vector<double> volume;
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
    volume.push_back(layer_volume);
    cycle_ += layer_volume;
    share_.push_back(std::move(share));
  }
  if (volume.empty()) {
    throw Failure(ExitCode::wrong_input,
                  "charging.layers is empty; the tracer stage needs at least one layer to charge");
  }
  divide_into_zones(campaign, volume, places);
  position_ = std::fmod(position_, cycle_);
  if (position_ < 0) position_ += cycle_;
}

void ChargePlan::divide_into_zones(const Campaign& campaign, const std::vector<double>& volume,
                                   const std::vector<Place>& places) {
  const std::size_t layers = volume.size();
  // A zone is where the same layers lie.
  std::map<std::vector<bool>, std::size_t> known;
  Matrix matrix;
  std::vector<double> flow;
  double whole = 0;
  for (const Place& place : places) {
    std::vector<bool> lies(layers, true);
    for (std::size_t l = 0; l < layers; ++l) {
      const auto ring = campaign.charging.ring_of(l);
      lies[l] = !ring || (place.distance >= (*ring)[0] && place.distance <= (*ring)[1]);
    }
    const auto [zone, fresh] = known.emplace(lies, known.size());
    if (fresh) {
      matrix.emplace_back(lies.begin(), lies.end());
      flow.push_back(0);
    }
    zone_of_place_.push_back(zone->second);
    flow[zone->second] += place.volume_rate;
    whole += place.volume_rate;
  }
  const auto whole_recipe = [](const std::vector<double>& zone) {
    return std::all_of(zone.begin(), zone.end(), [](double lies) { return lies > 0; });
  };
  if (known.empty() || (known.size() == 1 && whole_recipe(matrix.front()))) {
    // The same everywhere.
    matrix.assign(1, std::vector<double>(layers, 1.0));
    flow.assign(1, 1.0);
    whole = 1;
  }
  for (std::size_t l = 0; l < layers; ++l) {
    const bool somewhere = std::any_of(matrix.begin(), matrix.end(), [&](const auto& zone) { return zone[l] > 0; });
    if (!somewhere) {
      throw Failure(ExitCode::wrong_input,
                    fmt::format("charging.layers[{}].ring holds no cell of the stock plane; make it at least a cell "
                                "wide",
                                l))
          .at("key", fmt::format("charging.layers[{}].ring", l));
    }
  }
  std::vector<double> column;
  for (const double v : volume) column.push_back(v / cycle_);
  for (std::size_t z = 0; z < flow.size(); ++z) {
    flow[z] /= whole;
    for (std::size_t l = 0; l < layers; ++l) matrix[z][l] *= flow[z] * column[l];
  }
  matrix = fit(std::move(matrix), flow, column);
  for (std::size_t z = 0; z < flow.size(); ++z) {
    std::vector<double> ends;
    double end = 0;
    for (const double part : matrix[z]) {
      end += flow[z] > 0 ? part / flow[z] * cycle_ : 0;
      ends.push_back(end);
    }
    ends.back() = cycle_;
    end_.push_back(std::move(ends));
  }
}

std::vector<ChargePlan::Piece> ChargePlan::pieces(double from, double to, std::size_t zone) const {
  const std::vector<double>& end = end_[zone];
  std::vector<Piece> result;
  double time = from;
  const double passed = position_ + rate_ * from;
  double turn = std::floor(passed / cycle_);
  const double in_cycle = passed - turn * cycle_;
  std::size_t layer = 0;
  while (layer + 1 < end.size() && in_cycle >= end[layer]) ++layer;
  while (time < to) {
    const double layer_ends = (turn * cycle_ + end[layer] - position_) / rate_;
    const double until = std::min(to, layer_ends);
    if (until > time) {
      result.push_back({time, until, layer, &share_[layer]});
      time = until;
    }
    if (++layer == end.size()) {
      layer = 0;
      turn += 1;
    }
  }
  return result;
}

double ChargePlan::thinnest_layer_seconds() const {
  double thinnest = cycle_;
  for (const std::vector<double>& end : end_) {
    for (std::size_t layer = 0; layer < end.size(); ++layer) {
      const double volume = layer == 0 ? end[0] : end[layer] - end[layer - 1];
      if (volume > 0) thinnest = std::min(thinnest, volume);
    }
  }
  return thinnest / rate_;
}

}  // namespace cupola
