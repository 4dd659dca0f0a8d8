#include "stage_tracer/step_error.hpp"

#include <algorithm>
#include <cmath>

#include "physics/closures/enthalpy_zero.hpp"

namespace cupola {

SolidsState::SolidsState(const CellContents& contents, const Campaign& campaign)
    : capacity(contents.volume.front().size(), 0.0), temperature(capacity.size(), enthalpy_zero) {
  for (std::size_t c = 0; c < capacity.size(); ++c) {
    double heat = 0;
    for (std::size_t s = 0; s < contents.volume.size(); ++s) {
      const Species& species = campaign.species[s];
      const double here = contents.temperature[s][c];
      const double holds = contents.volume[s][c] * species.density * species.heat_capacity.at(here);
      capacity[c] += holds;
      heat += holds * here;
    }
    if (capacity[c] > 0) temperature[c] = heat / capacity[c];
  }
}

double temperature_difference(const SolidsState& one, const SolidsState& other) {
  double square = 0;
  double norm = 0;
  for (std::size_t c = 0; c < other.capacity.size(); ++c) {
    if (!(one.capacity[c] > 0)) continue;
    square += other.capacity[c] * std::pow(one.temperature[c] - other.temperature[c], 2);
    norm += other.capacity[c] * std::pow(other.temperature[c] - enthalpy_zero, 2);
  }
  return norm > 0 ? std::sqrt(square / norm) : 0;
}

double StepError::growth() const {
  const double longer = seconds / (2 * step);
  if (!known() || !(longer > 1) || !(early > 0) || !(late > 0)) return 1;
  return std::clamp(std::log(late / early) / std::log(longer), 0.5, 1.0);
}

double StepError::after(double duration, double length) const {
  if (!known()) return 0;
  return late * length / step * std::pow(std::max(seconds, std::min(duration, memory)) / seconds, growth());
}

std::vector<double> StepTrial::row() const {
  std::vector<double> result = {static_cast<double>(begin), static_cast<double>(pairs)};
  for (const auto* part : {&early.capacity, &early.temperature, &late.capacity, &late.temperature})
    result.insert(result.end(), part->begin(), part->end());
  return result;
}

StepTrial StepTrial::from_row(const std::vector<double>& row) {
  StepTrial trial{static_cast<long>(row.at(0)), static_cast<long>(row.at(1)), {}, {}};
  const auto cells = static_cast<std::ptrdiff_t>((row.size() - 2) / 4);
  auto next = row.begin() + 2;
  for (auto* part : {&trial.early.capacity, &trial.early.temperature, &trial.late.capacity, &trial.late.temperature}) {
    part->assign(next, next + cells);
    next += cells;
  }
  return trial;
}

}  // namespace cupola
