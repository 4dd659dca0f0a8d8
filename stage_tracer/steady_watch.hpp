#pragma once
#include <cstddef>
#include <optional>
#include <vector>

namespace cupola {

/// What the march says about the distance to its steady state.
struct RemainingChange {
  double change = 0;  ///< extrapolated change of the solids temperature still to come, over rms(T - 293 K)
  double ratio = 0;   ///< of two successive changes of the field (lambda), as measured
  double last = 0;    ///< the last of them, over rms(T - 293 K)
};

/// Judges from means over whole layer passages (windows) how far the march is from its steady state.  A flat last hour
/// is no proof: the slow mode takes hours (NUMERICS_NOTES, point 8).  Of the windows so far the first quarter is left
/// out, the others make three blocks of equal length with mean fields A, B, C;
///   lambda = <C - B, B - A>/<B - A, B - A>,   change still to come = lambda/(1 - lambda) |C - B| / rms(T - 293 K),
/// with the heat capacities as weights, stagnant cells left out.  lambda counts as at least 0.3, so that noise does not
/// end the march, and above 0.95 nothing can be said.
///
/// A window's field is the heat-capacity weighted mean temperature of the solids of each cell.  When
/// `most_windows` are kept, neighbours are joined two by two.
class SteadyWatch {
 public:
  /// Adds the mean field of a window. @param capacity J/K, @param temperature K, both all cells; 0 where left out
  void add(const std::vector<double>& capacity, const std::vector<double>& temperature);

  /// Nothing before twenty windows, and where the changes do not shrink.
  [[nodiscard]] std::optional<RemainingChange> remaining() const;

  /// How many times in a row, the last among them, the remaining change was known and at most `wanted`.
  [[nodiscard]] int below(double wanted) const;
  [[nodiscard]] std::size_t windows() const { return added_; }

  [[nodiscard]] std::vector<double> row() const;
  void restore(const std::vector<double>& row);

  static constexpr std::size_t least_windows = 20;
  static constexpr std::size_t most_windows = 64;

 private:
  void join_neighbours();

  struct Window {
    std::vector<float> capacity, temperature;
  };
  std::vector<Window> windows_;
  std::size_t added_ = 0;
  std::size_t joined_ = 1;       ///< windows in each one kept
  std::vector<double> changes_;  ///< remaining change after each window kept; negative: unknown
  Window open_;                  ///< waiting for its neighbour
  std::size_t open_count_ = 0;
};

}  // namespace cupola
