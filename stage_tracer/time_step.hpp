#pragma once
#include "stage_tracer/charge_plan.hpp"
#include "stage_tracer/granular_field.hpp"

namespace cupola {

/// Steps of equal length that fill the stage's duration.
struct TimeSteps {
  long count = 1;
  double length = 0;  ///< s
};

/// Equal steps of at most `longest` that fill a duration.
TimeSteps fill_with_steps(double duration, double longest);

/// The given step, or (`auto`) a fifth of the time in which a cell of the moving bed is crossed (a tenth
/// of the bed's volume is crossed faster than that) and at most a fifth of the thinnest layer's passage.  Transport
/// across cells and layers limits the accuracy, not heat, which is exact for any step (NUMERICS_NOTES).
/// @param charge null for a bed at rest, whose `auto` step is a hundredth of the duration
TimeSteps choose_time_steps(const BedMesh& mesh, const Campaign& campaign, const GranularField& field,
                            const PathField& paths, const ChargePlan* charge);

}  // namespace cupola
