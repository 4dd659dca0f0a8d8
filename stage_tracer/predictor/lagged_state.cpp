#include "stage_tracer/predictor/lagged_state.hpp"

#include <algorithm>

namespace cupola {
namespace {

/// Temperatures are counted in thousands of kelvins, so that they weigh about as much as fractions.
constexpr double kilo = 1000;
constexpr std::size_t depth = 5;
/// Share of the way to what came out that is gone without any knowledge.
constexpr double step = 0.7;

}  // namespace

/// For each cell: gas temperature, f, and of each species its fraction of the cell and that times its temperature.
std::vector<double> LaggedIteration::flat(const LaggedState& state) const {
  const std::size_t species = state.contents.volume.size();
  const std::size_t columns = 2 + 2 * species;
  std::vector<double> x(mesh_.cells() * columns, 0.0);
  for (std::size_t c = 0; c < mesh_.cells(); ++c) {
    if (!bed_[c]) continue;
    double* row = &x[c * columns];
    row[0] = state.gas[c] / kilo;
    row[1] = state.share[c];
    for (std::size_t s = 0; s < species; ++s) {
      row[2 + 2 * s] = state.contents.volume[s][c] / mesh_.cell_volume[c];
      row[3 + 2 * s] = row[2 + 2 * s] * state.contents.temperature[s][c] / kilo;
    }
  }
  return x;
}

void LaggedIteration::advance(LaggedState& state, const LaggedState& result) {
  const std::size_t species = state.contents.volume.size();
  const std::size_t columns = 2 + 2 * species;
  const std::vector<double> x = flat(state);
  std::vector<double> way = flat(result);
  for (std::size_t i = 0; i < x.size(); ++i) way[i] = step * (way[i] - x[i]);
  if (!acceleration_) {
    std::vector<double> weight(x.size());
    for (std::size_t i = 0; i < x.size(); ++i) weight[i] = mesh_.cell_volume[i / columns];
    acceleration_.emplace(depth, std::move(weight));
  }
  const std::vector<double> next = acceleration_->next(x, way);
  state = result;
  for (std::size_t c = 0; c < mesh_.cells(); ++c) {
    if (!bed_[c]) continue;
    const double* row = &next[c * columns];
    state.gas[c] = std::clamp(kilo * row[0], lowest_, highest_);
    state.share[c] = std::clamp(row[1], least_share_, 1.0);
    for (std::size_t s = 0; s < species; ++s) {
      const double fraction = std::max(row[2 + 2 * s], 0.0);
      state.contents.volume[s][c] = fraction * mesh_.cell_volume[c];
      if (fraction > 0) {
        state.contents.temperature[s][c] = std::clamp(kilo * row[3 + 2 * s] / fraction, lowest_, highest_);
      }
    }
  }
}

}  // namespace cupola
