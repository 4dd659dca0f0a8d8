#pragma once
#include <cstdint>
#include <vector>

#include "schemas/campaign.hpp"
#include "stage_tracer/ranks.hpp"
#include "stage_tracer/tracers.hpp"

namespace cupola {

/// Temperatures of this rank's tracers, by id, to be compared later.
struct TracerTemperatures {
  std::vector<std::int64_t> id;     ///< rising
  std::vector<double> temperature;  ///< K

  explicit TracerTemperatures(const Tracers& tracers);
};

/// Root mean square of T - T_other over that of T_other - 293 K, over the tracers that both hold, with their heat
/// capacities as weights, on all ranks: from one step of twice the length and two steps it is the error of the two
/// steps where the method is of first order, and three times it where it is of second (step doubling).
double temperature_difference(const TracerTemperatures& one, const Tracers& other, const Campaign& campaign,
                              const SumOverRanks& sum);

/// The estimate of what the time step costs in accuracy.
struct StepError {
  double pair = 0;     ///< last difference found between one step of twice the length and two steps
  double seconds = 0;  ///< s, length of the step it belongs to

  /// Error of the temperatures after `duration` s: the errors of pairs of steps add up, for as long as the bed
  /// remembers them, `memory` s.
  [[nodiscard]] double after(double duration, double memory) const;
};

}  // namespace cupola
