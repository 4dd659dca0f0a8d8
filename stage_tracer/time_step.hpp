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

/// What bounds the step where it follows from the accuracy, s.
struct StepLimits {
  double first = 0;  ///< the first one
  double shortest = 0;
  double longest = 0;
};

/// Of the time in which a cell of the moving bed is crossed (a tenth of the bed's volume is crossed faster than that),
/// or of the thinnest layer's passage where that is less, the first step is at most a fifth, the longest half and the
/// shortest a tenth: below that single tracers that melt a step earlier or later weigh more
/// than the step.  Transport across cells and layers limits the accuracy, not heat, which is exact for any step
/// (NUMERICS_NOTES).
/// @param charge null for a bed at rest, whose first step is a hundredth of the duration
StepLimits step_limits(const BedMesh& mesh, const Campaign& campaign, const GranularField& field,
                       const PathField& paths, const ChargePlan* charge);

}  // namespace cupola
