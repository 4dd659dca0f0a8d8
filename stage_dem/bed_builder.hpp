#pragma once
#include <nlohmann/json.hpp>
#include <vector>

#include "stage_dem/engine.hpp"
#include "stage_dem/ore_temperature.hpp"

namespace cupola {

/// Makes the initial layered bed from the bottom up to the stock line: the charging recipe's layers at the thickness
/// they have at the stock line, each poured at random a short way above the bed and left to fall before the next.  A
/// species that softens goes only where the guessed temperature leaves it solid and above its `none_below`; elsewhere
/// the first species that does not soften.
class BedBuilder {
 public:
  explicit BedBuilder(const Campaign& campaign);

  /// Called between blocks. @return parcels to add now
  std::vector<Parcel> pour(const std::vector<Parcel>& parcels, const OreTemperature& temperature, double time,
                           std::uint64_t seed, std::int64_t& next_id);

  /// Whether the bed has reached the stock line and the last parcels have been poured.
  [[nodiscard]] bool done() const { return done_; }
  /// Index of the layer that is charged next.
  [[nodiscard]] std::int64_t next_layer() const { return next_layer_; }

  [[nodiscard]] nlohmann::json save() const;
  void load(const nlohmann::json& state);

 private:
  void begin_layer(double surface);
  [[nodiscard]] int species_at(double x, double share, const OreTemperature& temperature) const;

  const Campaign& campaign_;
  std::int64_t next_layer_ = 0;
  std::int64_t layer_ = 0;  ///< the running one
  double base_ = 0;         ///< m, surface when the running layer began
  double thickness_ = 0;    ///< m
  double volume_left_ = 0;  ///< m3 of contact volume still to pour
  double not_before_ = 0;   ///< s
  bool done_ = false;
};

}  // namespace cupola
