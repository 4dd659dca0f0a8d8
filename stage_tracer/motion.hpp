#pragma once
#include <vector>

#include "physics/motion/path.hpp"
#include "schemas/campaign.hpp"
#include "stage_tracer/granular_field.hpp"
#include "stage_tracer/insertion.hpp"
#include "stage_tracer/removal.hpp"
#include "stage_tracer/stays.hpp"

namespace cupola {

/// Moves tracers along the exact paths of the granular field.  In the raceways a tracer's life runs down at the local
/// removal rate and the tracer goes when it is used up, so that the expected removal is the stated one on any number of
/// ranks and for any step.  Melting species that get below their `none_below` are removed as unmelted (MODEL 4).
class Motion {
 public:
  Motion(const Campaign& campaign, const GranularField& field, const PathField& paths);

  struct Moved {
    Stays stays;      ///< of all tracers, the new and the leaving ones too
    Leaving leaving;  ///< those that leave; they are still there, for what they exchanged on their way
  };
  /// Moves this rank's tracers over [from, to]; `entries` (this rank's, sorted by id) join at their exact times with
  /// the charge's temperature and are counted.  Who leaves goes with `remove_leaving`.
  [[nodiscard]] Moved advance(Tracers& tracers, double from, double to, const std::vector<Entry>& entries,
                              std::uint64_t seed, Tally& tally) const;

 private:
  /// Uses up the tracer's life by its stays from `first` on; cuts them short where it ends. @return whether it ended
  bool live(double& life, std::vector<PathField::Stay>& stays, std::size_t first) const;

  const Campaign& campaign_;
  const GranularField& field_;
  const PathField& paths_;
  double none_below_;                ///< m, highest `none_below`
  std::vector<std::uint8_t> marks_;  ///< of each cell: what a tracer that stays in it has to look at
};

}  // namespace cupola
