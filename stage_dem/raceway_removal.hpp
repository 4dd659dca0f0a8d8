#pragma once
#include <nlohmann/json.hpp>
#include <vector>

#include "stage_dem/mass_books.hpp"

namespace cupola {

/// Takes parcels out of the raceways at their mass rates (MODEL 4).  A raceway is owed rate x time; while it is owed a
/// whole parcel, one of those in its box, whatever the species, is drawn at random and taken out.  What a raceway
/// cannot get for more than a second is forgone and counted as starvation, so that it is not made up for in a gulp.  A
/// raceway that keeps a void takes only what fills its box beyond that void (material volume over the box's, the last
/// whole parcel left in), at most at its rate, and does not starve.
class RacewayRemoval {
 public:
  explicit RacewayRemoval(const Campaign& campaign);

  /// @param parcels all, by id  @return ids to remove, already in the books
  std::vector<std::int64_t> remove(const std::vector<Parcel>& parcels, double seconds, std::uint64_t seed, long step,
                                   MassBooks& books);

  /// Seconds in which a raceway got less than it was owed, summed over raceways.
  [[nodiscard]] double starved_seconds() const { return starved_seconds_; }

  [[nodiscard]] nlohmann::json save() const { return {{"owed", owed_}, {"starved_seconds", starved_seconds_}}; }
  void load(const nlohmann::json& state);

 private:
  const Campaign& campaign_;
  std::vector<double> owed_;  ///< kg a raceway
  double starved_seconds_ = 0;
};

}  // namespace cupola
