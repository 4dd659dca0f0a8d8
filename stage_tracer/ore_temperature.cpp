#include "stage_tracer/ore_temperature.hpp"

#include <algorithm>
#include <cmath>

namespace cupola {
namespace {

/// Fills one column; false where it holds no ore.
bool continue_column(const BedMesh& mesh, const Column& column, const std::vector<double>& temperature,
                     const std::vector<double>& weight, const std::vector<double>& least_weight,
                     const Softening& softening, std::vector<double>& result) {
  std::vector<std::int64_t> with_ore;
  std::vector<double> values;
  std::vector<double> weights;
  for (const std::int64_t cell : column.cells) {
    if (weight[cell] <= least_weight[cell]) continue;
    with_ore.push_back(cell);
    values.push_back(temperature[cell]);
    weights.push_back(weight[cell]);
  }
  if (with_ore.empty()) return false;
  const std::vector<double> rising = isotonic(values, weights);
  const double last_height = mesh.cell_centre[with_ore.back()][2];
  double gradient = 0;
  if (with_ore.size() > 1) {
    const double step = mesh.cell_centre[with_ore[with_ore.size() - 2]][2] - last_height;
    gradient = (rising.back() - rising[rising.size() - 2]) / step;
  }
  const double highest = std::max(rising.back(), 2 * softening.melted - softening.from);
  std::size_t k = 0;
  for (const std::int64_t cell : column.cells) {
    const double height = mesh.cell_centre[cell][2];
    if (k < with_ore.size() && cell == with_ore[k]) {
      result[cell] = rising[k++];
    } else if (k == 0) {
      result[cell] = rising.front();
    } else if (k < with_ore.size()) {
      const double upper = mesh.cell_centre[with_ore[k - 1]][2];
      const double lower = mesh.cell_centre[with_ore[k]][2];
      result[cell] = rising[k - 1] + (rising[k] - rising[k - 1]) * (upper - height) / (upper - lower);
    } else {
      result[cell] = std::clamp(rising.back() + gradient * (last_height - height), softening.melted, highest);
    }
  }
  return true;
}

}  // namespace

std::vector<double> isotonic(const std::vector<double>& values, const std::vector<double>& weights) {
  struct Pool {
    double mean, weight;
    std::size_t count;
  };
  std::vector<Pool> pools;
  for (std::size_t i = 0; i < values.size(); ++i) {
    pools.push_back({values[i], weights[i], 1});
    while (pools.size() > 1 && pools[pools.size() - 2].mean > pools.back().mean) {
      const Pool last = pools.back();
      pools.pop_back();
      Pool& joined = pools.back();
      joined.mean = (joined.mean * joined.weight + last.mean * last.weight) / (joined.weight + last.weight);
      joined.weight += last.weight;
      joined.count += last.count;
    }
  }
  std::vector<double> result;
  for (const Pool& pool : pools) result.insert(result.end(), pool.count, pool.mean);
  return result;
}

std::vector<double> continue_ore_temperature(const BedMesh& mesh, const std::vector<Column>& columns,
                                             const std::vector<double>& temperature, const std::vector<double>& weight,
                                             const std::vector<double>& least_weight, const Softening& softening,
                                             double outside) {
  std::vector<double> result(mesh.cells(), outside);
  std::vector<const Column*> filled;
  std::vector<const Column*> bare;
  for (const Column& column : columns) {
    (continue_column(mesh, column, temperature, weight, least_weight, softening, result) ? filled : bare)
        .push_back(&column);
  }
  // A column without ore follows the nearest one that has some, cell by cell from the top.
  for (const Column* column : bare) {
    const auto nearest = std::min_element(filled.begin(), filled.end(), [&](const Column* a, const Column* b) {
      return std::abs(a->x - column->x) < std::abs(b->x - column->x);
    });
    for (std::size_t i = 0; i < column->cells.size(); ++i) {
      result[column->cells[i]] = nearest == filled.end()
                                     ? softening.melted
                                     : result[(*nearest)->cells[std::min(i, (*nearest)->cells.size() - 1)]];
    }
  }
  return result;
}

}  // namespace cupola
