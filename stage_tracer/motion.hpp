#pragma once
#include <vector>

#include "physics/motion/path.hpp"
#include "schemas/campaign.hpp"
#include "stage_tracer/granular_field.hpp"
#include "stage_tracer/insertion.hpp"
#include "stage_tracer/removal.hpp"
#include "stage_tracer/tracers.hpp"

namespace cupola {

/// Moves tracers along the exact paths of the granular field.  In the raceways a tracer's life runs down at the local
/// removal rate and the tracer goes when it is used up, so that the expected removal is the stated one on any number of
/// ranks and for any step.  Melting species that get below their `none_below` are removed as unmelted (MODEL 4).
class Motion {
 public:
  Motion(const Campaign& campaign, const GranularField& field, const PathField& paths);

  /// Moves this rank's tracers over [from, to]; `entries` (this rank's, sorted by id) join at their exact times with
  /// the charge's temperature.
  void advance(Tracers& tracers, double from, double to, const std::vector<Entry>& entries, std::uint64_t seed,
               Tally& tally) const;

 private:
  const Campaign& campaign_;
  const GranularField& field_;
  const PathField& paths_;
  double none_below_;                ///< m, highest `none_below`
  std::vector<std::uint8_t> marks_;  ///< of each cell: what a tracer that stays in it has to look at
};

}  // namespace cupola
