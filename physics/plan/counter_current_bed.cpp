#include "physics/plan/counter_current_bed.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "physics/closures/enthalpy_zero.hpp"
#include "physics/plan/small_linear_system.hpp"

namespace cupola {
namespace {

constexpr double transfer_units_of_a_cell = 0.02;
constexpr int fewest_cells = 500, most_cells = 100000;

/// Value at a node as `constant + slope x gas temperature` of that node or of the node below.
struct Affine {
  double constant = 0, slope = 0;
};

std::vector<double> nodes_of(double length, int cells, const std::vector<double>& ends) {
  std::vector<double> nodes;
  for (int i = 0; i <= cells; ++i) nodes.push_back(length * i / cells);
  for (const double end : ends) {
    if (end > 0 && end < length) nodes.push_back(end);
  }
  std::sort(nodes.begin(), nodes.end());
  // An end that falls on a node up to round-off makes no cell of its own.
  const double smallest = 1e-9 * length / cells;
  nodes.erase(std::unique(nodes.begin(), nodes.end(), [&](double a, double b) { return b - a < smallest; }),
              nodes.end());
  return nodes;
}

/// One direct solution with given ends of the solids.
CounterCurrentSolution sweep(const CounterCurrentBed& bed, int cells, const std::vector<double>& ends) {
  const std::size_t kinds = bed.solids.size();
  CounterCurrentSolution result;
  result.depth = nodes_of(bed.length, cells, ends);
  result.end_depth = ends;
  const std::size_t nodes = result.depth.size();
  result.gas_temperature.assign(nodes, 0);
  result.solids_temperature.assign(kinds, std::vector<double>(nodes, 0));

  // Going down.  `solids[i][n]`: T_i at node n from the gas at node n; `gas[n]`: gas at node n from the gas at node n
  // + 1.
  std::vector<std::vector<Affine>> solids(kinds, std::vector<Affine>(nodes));
  std::vector<Affine> gas(nodes);
  std::vector<BedExchange> exchange(nodes);
  for (std::size_t i = 0; i < kinds; ++i) solids[i][0] = {bed.solids[i].charged_at, 0};
  SmallLinearSystem system(kinds + 1, 2);
  for (std::size_t n = 0; n + 1 < nodes; ++n) {
    const double height = result.depth[n + 1] - result.depth[n];
    const double middle = (result.depth[n + 1] + result.depth[n]) / 2;
    exchange[n] = bed.exchange(middle, present_at(middle, ends));
    const BedExchange& x = exchange[n];
    // Unknowns: T_i at n + 1, then the gas at n; right-hand sides: the constant and the factor of the gas at n + 1.
    system.clear();
    const double half = height / 2;
    const std::size_t g = kinds;
    const auto add_mean_solid = [&](std::size_t row, std::size_t i,
                                    double factor) {  // factor x (T_i(n) + T_i(n+1))/2 x height
      system.matrix(row, i) += factor * half;
      system.matrix(row, g) += factor * half * solids[i][n].slope;
      system.right(row, 0) -= factor * half * solids[i][n].constant;
    };
    const auto add_mean_gas = [&](std::size_t row, double factor) {
      system.matrix(row, g) += factor * half;
      system.right(row, 1) -= factor * half;
    };
    for (std::size_t i = 0; i < kinds; ++i) {
      const double flow = bed.solids[i].heat_capacity_flow;
      system.matrix(i, i) += flow;
      system.matrix(i, g) -= flow * solids[i][n].slope;
      system.right(i, 0) += flow * solids[i][n].constant;
      add_mean_gas(i, -x.gas[i]);
      add_mean_solid(i, i, x.gas[i]);
      if (kinds == 2) {
        add_mean_solid(i, i, x.between_solids);
        add_mean_solid(i, 1 - i, -x.between_solids);
      }
      add_mean_solid(g, i, x.gas[i]);
      add_mean_gas(g, -x.gas[i]);
    }
    system.matrix(g, g) -= bed.gas_heat_capacity_flow;
    system.right(g, 1) -= bed.gas_heat_capacity_flow;
    add_mean_gas(g, -x.wall);
    system.right(g, 0) -= x.wall * height * bed.wall_temperature;
    system.solve();
    for (std::size_t i = 0; i < kinds; ++i) solids[i][n + 1] = {system.right(i, 0), system.right(i, 1)};
    gas[n] = {system.right(g, 0), system.right(g, 1)};
  }

  // Going up.
  result.gas_temperature[nodes - 1] = bed.gas_enters_at;
  for (std::size_t n = nodes - 1; n-- > 0;) {
    result.gas_temperature[n] = gas[n].constant + gas[n].slope * result.gas_temperature[n + 1];
  }
  for (std::size_t i = 0; i < kinds; ++i) {
    for (std::size_t n = 0; n < nodes; ++n) {
      result.solids_temperature[i][n] = solids[i][n].constant + solids[i][n].slope * result.gas_temperature[n];
    }
    const double taken = result.solids_temperature[i][nodes - 1] - bed.solids[i].charged_at;
    result.to_solids.push_back(bed.solids[i].heat_capacity_flow * taken);
  }
  for (std::size_t n = 0; n + 1 < nodes; ++n) {
    const double mean = (result.gas_temperature[n] + result.gas_temperature[n + 1]) / 2;
    result.to_wall += exchange[n].wall * (result.depth[n + 1] - result.depth[n]) * (mean - bed.wall_temperature);
  }
  result.gas_in = bed.gas_heat_capacity_flow * (bed.gas_enters_at - enthalpy_zero);
  result.gas_out = bed.gas_heat_capacity_flow * (result.gas_temperature[0] - enthalpy_zero);
  return result;
}

int cells_for(const CounterCurrentBed& bed) {
  const std::vector<bool> all(bed.solids.size(), true);
  double most = 0;
  for (int i = 0; i <= 100; ++i) {
    const BedExchange x = bed.exchange(bed.length * i / 100, all);
    double of_gas = x.wall;
    for (std::size_t k = 0; k < bed.solids.size(); ++k) {
      of_gas += x.gas[k];
      most = std::max(most, (x.gas[k] + x.between_solids) / bed.solids[k].heat_capacity_flow);
    }
    most = std::max(most, of_gas / bed.gas_heat_capacity_flow);
  }
  const double wanted = bed.length * most / transfer_units_of_a_cell;
  return static_cast<int>(std::clamp(wanted, double{fewest_cells}, double{most_cells}));
}

/// How much hotter than its melting temperature a kind is at its end.
double overshoot(const CounterCurrentBed& bed, const CounterCurrentSolution& solution, std::size_t kind) {
  return solution.solids_temperature[kind].back() - *bed.solids[kind].melts_at;
}

}  // namespace

std::vector<bool> present_at(double depth, const std::vector<double>& end_depth) {
  std::vector<bool> present(end_depth.size());
  std::transform(end_depth.begin(), end_depth.end(), present.begin(), [&](double end) { return depth < end; });
  return present;
}

double CounterCurrentSolution::residual() const {
  double rest = gas_in - gas_out - to_wall;
  for (const double taken : to_solids) rest -= taken;
  return rest;
}

std::optional<double> CounterCurrentSolution::depth_of(std::size_t kind, double temperature) const {
  const auto& t = solids_temperature[kind];
  for (std::size_t n = 1; n < depth.size() && depth[n - 1] < end_depth[kind]; ++n) {
    if (t[n] >= temperature && t[n - 1] < temperature) {
      return depth[n - 1] + (depth[n] - depth[n - 1]) * (temperature - t[n - 1]) / (t[n] - t[n - 1]);
    }
  }
  return std::nullopt;
}

CounterCurrentSolution solve_counter_current_bed(const CounterCurrentBed& bed, int cells) {
  if (cells <= 0) cells = cells_for(bed);
  std::vector<double> ends;
  for (const DescendingSolids& kind : bed.solids) {
    ends.push_back(kind.melts_at ? std::min(kind.none_below, bed.length) : bed.length);
  }
  std::vector<std::optional<double>> melting(bed.solids.size());
  CounterCurrentSolution solution = sweep(bed, cells, ends);
  const auto melting_kinds = std::count_if(bed.solids.begin(), bed.solids.end(),
                                           [](const DescendingSolids& kind) { return kind.melts_at.has_value(); });
  // Where several kinds melt, each end depends on the others: found in turn until none moves.
  constexpr int most_rounds = 30;
  for (int round = 0; round < most_rounds; ++round) {
    double moved = 0;
    for (std::size_t kind = 0; kind < bed.solids.size(); ++kind) {
      if (!bed.solids[kind].melts_at) continue;
      const double before = ends[kind];
      double lower = std::min(bed.solids[kind].none_below, bed.length), upper = 0;
      ends[kind] = lower;
      solution = sweep(bed, cells, ends);
      melting[kind].reset();
      if (overshoot(bed, solution, kind) >= 0) {
        while (lower - upper > 1e-12 * bed.length) {
          ends[kind] = (lower + upper) / 2;
          solution = sweep(bed, cells, ends);
          (overshoot(bed, solution, kind) >= 0 ? lower : upper) = ends[kind];
        }
        melting[kind] = ends[kind];
      }
      moved = std::max(moved, std::abs(ends[kind] - before));
    }
    if (melting_kinds <= 1 || moved <= 1e-9 * bed.length) break;
  }
  solution.melting_depth = std::move(melting);
  return solution;
}

}  // namespace cupola
