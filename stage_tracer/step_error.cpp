#include "stage_tracer/step_error.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "stage_tracer/removal.hpp"

namespace cupola {

TracerTemperatures::TracerTemperatures(const Tracers& tracers) {
  std::vector<std::size_t> order(tracers.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) { return tracers.id[a] < tracers.id[b]; });
  for (const std::size_t i : order) {
    id.push_back(tracers.id[i]);
    temperature.push_back(tracers.temperature[i]);
  }
}

double temperature_difference(const TracerTemperatures& one, const Tracers& other, const Campaign& campaign,
                              const SumOverRanks& sum) {
  std::vector<double> squares(2, 0.0);
  for (std::size_t i = 0; i < other.size(); ++i) {
    const auto found = std::lower_bound(one.id.begin(), one.id.end(), other.id[i]);
    if (found == one.id.end() || *found != other.id[i]) continue;
    const double temperature = one.temperature[static_cast<std::size_t>(found - one.id.begin())];
    const Species& species = campaign.species[other.species[i]];
    const double capacity = other.volume[i] * species.density * species.heat_capacity.at(other.temperature[i]);
    squares[0] += capacity * std::pow(temperature - other.temperature[i], 2);
    squares[1] += capacity * std::pow(other.temperature[i] - enthalpy_zero, 2);
  }
  sum(squares);
  return squares[1] > 0 ? std::sqrt(squares[0] / squares[1]) : 0;
}

double StepError::after(double duration, double memory) const {
  return seconds > 0 ? pair / (2 * seconds) * std::min(duration, memory) : 0;
}

}  // namespace cupola
