#pragma once
#include <functional>
#include <optional>
#include <vector>

namespace cupola {

/// Solids of one kind on their way down.
struct DescendingSolids {
  double heat_capacity_flow = 0;   ///< W/K, mass flow x heat capacity
  double charged_at = 0;           ///< K
  std::optional<double> melts_at;  ///< K; it leaves the bed where it gets this hot
  double none_below = 0;           ///< m of depth: at the latest here it leaves (only what can melt)
};

/// Conductances per metre of height, W/m/K.
struct BedExchange {
  std::vector<double> gas;    ///< between gas and each kind of solids
  double between_solids = 0;  ///< between the two kinds, where there are exactly two; else 0
  double wall = 0;            ///< gas to wall
};

/// A one-dimensional bed: solids move down from depth 0, gas up from depth `length`.
struct CounterCurrentBed {
  double length = 0;                  ///< m
  double gas_heat_capacity_flow = 0;  ///< W/K
  double gas_enters_at = 0;           ///< K
  double wall_temperature = 293;      ///< K
  std::vector<DescendingSolids> solids;
  /// Conductances at a depth, given which kinds are there (a kind that has left must get 0).
  std::function<BedExchange(double depth, const std::vector<bool>& present)> exchange;
};

struct CounterCurrentSolution {
  std::vector<double> depth;                            ///< m, nodes, rising
  std::vector<double> gas_temperature;                  ///< K
  std::vector<std::vector<double>> solids_temperature;  ///< K, by kind; below its end the temperature it left with
  std::vector<std::optional<double>> melting_depth;     ///< m, by kind; none: never melts
  std::vector<double> end_depth;                        ///< m, by kind: where it leaves the bed
  double gas_in = 0, gas_out = 0;                       ///< W, above 293 K
  double to_wall = 0;                                   ///< W
  std::vector<double> to_solids;                        ///< W, by kind: what it takes along
  [[nodiscard]] double residual() const;                ///< W: in - out - wall - solids, zero but for round-off

  /// Uppermost depth at which a kind reaches a temperature before it leaves, m.
  [[nodiscard]] std::optional<double> depth_of(std::size_t kind, double temperature) const;
};

/// Which kinds are still there at a depth, given where each leaves.
std::vector<bool> present_at(double depth, const std::vector<double>& end_depth);

/// Steady temperatures of a counter-current bed,
///   C_i dT_i/ds = h_i (T_g - T_i) + e (T_j - T_i),   C_g dT_g/ds = sum h_i (T_g - T_i) + w (T_g - T_w),
/// s downwards, solids given at s = 0 and gas at s = length.
///
/// Trapezoidal cells: second order, and every watt that leaves one stream enters another, so that the balance closes to
/// round-off. Each sweep is direct: going down, the solids' temperatures are an affine function of the gas temperature
/// at the same node (all that the charge fixes); at the bottom the gas is known, and going up gives everything.  That
/// needs no guess and is stable for any number of transfer units, unlike shooting.  Where solids melt, their end is
/// found by bisection: at the depth where they reach the melting temperature when they leave just there; `never` where
/// they do not reach it by `none_below`.
/// @param cells of equal height; 0: as many as keep the transfer units of a cell below 0.02, at least 500
CounterCurrentSolution solve_counter_current_bed(const CounterCurrentBed& bed, int cells = 0);

}  // namespace cupola
