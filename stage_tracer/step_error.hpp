#pragma once
#include <vector>

#include "schemas/campaign.hpp"
#include "stage_tracer/cell_contents.hpp"

namespace cupola {

/// What the solids of all cells are at one instant.
struct SolidsState {
  std::vector<double> capacity;     ///< J/K
  std::vector<double> temperature;  ///< K

  SolidsState() = default;
  /// @param contents spread
  SolidsState(const CellContents& contents, const Campaign& campaign);
};

/// Root mean square of T - T_other over that of T_other - 293 K, over the cells, with their heat capacities as weights.
double temperature_difference(const SolidsState& one, const SolidsState& other);

/// What the time step costs in accuracy: the temperatures of the cells after some steps, compared with those after half
/// as many of twice the length from the same state.  Their difference is the error of the march where it is of first
/// order in the step, three times that where it is of second.  It is taken of cells, since the errors of single tracers
/// are in part random and cancel in what is asked for.
struct StepError {
  double step = 0;     ///< s, of the march; 0: nothing is known
  double early = 0;    ///< difference after two steps
  double late = 0;     ///< difference after `seconds`
  double seconds = 0;  ///< s
  double memory = 0;   ///< s, for how long the bed remembers what was wrong in a step

  [[nodiscard]] bool known() const { return step > 0; }
  /// The exponent with which the difference grows in time: 1 for errors that add up, 1/2 for random ones; limited to
  /// these.
  [[nodiscard]] double growth() const;
  /// Error of the temperatures after `duration` s of steps of `length`: it grows as it was seen to grow, for as long as
  /// the bed remembers, and is of first order in the step.
  [[nodiscard]] double after(double duration, double length) const;

  /// For a checkpoint.
  [[nodiscard]] std::vector<double> row() const { return {step, early, late, seconds, memory}; }
  static StepError from_row(const std::vector<double>& row) {
    return {row.at(0), row.at(1), row.at(2), row.at(3), row.at(4)};
  }
};

/// States of steps of twice the length, with which the march is compared when it gets there.
struct StepTrial {
  long begin = 0;     ///< step at which both began
  long pairs = 0;     ///< steps of twice the length
  SolidsState early;  ///< after the first of them
  SolidsState late;   ///< after the last

  /// For a checkpoint; empty for none.
  [[nodiscard]] std::vector<double> row() const;
  static StepTrial from_row(const std::vector<double>& row);
};

}  // namespace cupola
