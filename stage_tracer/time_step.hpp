#pragma once
#include "stage_tracer/charge_plan.hpp"
#include "stage_tracer/granular_field.hpp"

namespace cupola {

/// Steps of equal length that fill the stage's duration.
struct TimeSteps {
  long count = 1;
  double length = 0;      ///< s
  long first_step = 0;    ///< from which the steps have this length
  double first_time = 0;  ///< s of process time at `first_step`

  /// Process time after so many steps, s.
  [[nodiscard]] double time(double steps) const { return first_time + (steps - double(first_step)) * length; }
};

/// Steps of (at most) the same length from a step on that was reached with steps of another length: what remains of the
/// duration is filled anew. The same steps where `now` is the time they give.
TimeSteps steps_from(const TimeSteps& steps, long step, double now, double duration);

/// The given step, or (`auto`) a fifth of the time in which a cell of the moving bed is crossed (a tenth of the bed's
/// volume is crossed faster than that) and at most a fifth of the thinnest layer's passage.  Transport across cells and
/// layers limits the accuracy, not heat, which is exact for any step (NUMERICS_NOTES).  Shortened so that a whole
/// number of steps fills the duration.
/// @param charge null for a bed at rest, whose `auto` step is a hundredth of the duration
TimeSteps choose_time_steps(const BedMesh& mesh, const Campaign& campaign, const GranularField& field,
                            const PathField& paths, const ChargePlan* charge);

}  // namespace cupola
