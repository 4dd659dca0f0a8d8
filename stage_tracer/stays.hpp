#pragma once
#include <cstddef>
#include <optional>
#include <span>
#include <vector>

#include "stage_tracer/cell_contents.hpp"
#include "stage_tracer/removal.hpp"

namespace cupola {

/// In which cells the tracers of this rank were during a step, and for how long: their exact paths.  A tracer that
/// entered or left in the step was there for a part of it.
class Stays {
 public:
  using Stay = PathField::Stay;

  /// @param step s
  explicit Stays(double step = 0) : step_(step) {}
  /// Each of the tracers where it is, for all of the step.
  Stays(const Tracers& tracers, double step);

  [[nodiscard]] double step() const { return step_; }
  [[nodiscard]] std::size_t tracers() const { return end_.size(); }
  [[nodiscard]] const std::vector<Stay>& all() const { return stays_; }
  /// First stay of a tracer in `all`; that of the next one is the end of its own.
  [[nodiscard]] std::size_t first(std::size_t tracer) const { return tracer == 0 ? 0 : end_[tracer - 1]; }
  [[nodiscard]] std::span<const Stay> of(std::size_t tracer) const {
    return {stays_.data() + first(tracer), end_[tracer] - first(tracer)};
  }

  /// For what moves the tracers, one after the other: stays of the next one are appended to `open()`.
  [[nodiscard]] std::vector<Stay>& open() { return stays_; }
  void next_tracer() { end_.push_back(stays_.size()); }

 private:
  double step_;
  std::vector<Stay> stays_;
  std::vector<std::size_t> end_;  ///< of each tracer's stays
};

/// Means over the step of what all ranks' tracers carry in each cell, each with its temperature as it stands.
CellContents sum_stays(const Tracers& tracers, const Stays& stays, std::size_t species, std::size_t cells, bool heat,
                       const SumOverRanks& sum);

/// Sums the tracers in the cells they are in. @param heat whether tracers carry temperatures
CellContents sum_tracers(const Tracers& tracers, std::size_t species, std::size_t cells, bool heat,
                         const SumOverRanks& sum);

/// Why each tracer leaves the bed at the end of a step; none: it stays.
using Leaving = std::vector<std::optional<Cause>>;

/// Removes the tracers that leave and counts them.
void remove_leaving(Tracers& tracers, const Leaving& leaving, const Campaign& campaign, Tally& tally);

}  // namespace cupola
