#pragma once
#include <vector>

#include "schemas/campaign.hpp"
#include "stage_tracer/march_windows.hpp"

namespace cupola {

/// What the windows of a march that began with a prediction say.  The first is left out: in it the tracers still find
/// their composition.
struct MeasuredMarch {
  CellContents mean;        ///< over the windows looked at
  BySpecies tendency;       ///< K/s: second half less first half over the time between them, smoothed
  BySpecies error;          ///< K, standard error of `mean`, from the second differences of the windows
  double seconds = 0;       ///< of the windows looked at
  std::size_t windows = 0;  ///< looked at
};

/// @param windows at least four  @param smoothing passes of the kernel over the tendency
/// @throws Failure wrong_input where there are fewer
MeasuredMarch measure_march(const std::vector<MarchWindows::Window>& windows, const CellSpreading& kernel,
                            int smoothing);

/// rms of a difference of temperatures over the solids that both know, with heat capacities as weights, and the level
/// it is compared with.
struct TemperatureNorm {
  double difference = 0;  ///< K, rms
  double mean = 0;        ///< K, mean of a - b
  double level = 0;       ///< K, rms(a - 293 K)
  [[nodiscard]] double relative() const { return level > 0 ? difference / level : 0; }
};

/// @param volume m3, [species][cell]: only where it is positive @param left_out cells that stand still
TemperatureNorm temperature_norm(const Campaign& campaign, const BySpecies& volume, const std::vector<bool>& left_out,
                                 const BySpecies& a, const BySpecies& b);

/// Volume-weighted smoothing of a field of each species, `passes` times with the kernel of a parcel.
BySpecies smoothed(const BySpecies& volume, BySpecies values, const CellSpreading& kernel, int passes);

}  // namespace cupola
