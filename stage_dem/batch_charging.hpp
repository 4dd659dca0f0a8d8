#pragma once
#include <array>
#include <nlohmann/json.hpp>
#include <set>
#include <vector>

#include "stage_dem/engine.hpp"

namespace cupola {

/// Where the sequence of batches stands.
struct ChargingState {
  std::int64_t next_layer = 0;     ///< index into the recipe
  std::vector<std::int64_t> owed;  ///< parcels a species of the running batch not yet poured
  std::vector<double> carried;     ///< kg a species carried over, less than a parcel
  double not_before = 0;           ///< s, process time before which no new batch begins: the last one is still falling
  std::set<std::int64_t> falling;  ///< parcels poured and not yet at rest on the bed
};

/// Charges batches of fixed mass when the bed's surface is below the stock line.  A batch is a whole number of parcels;
/// the rest of its mass is carried to the next batch of that species, so that the charged mass is exact over time.  It
/// is poured from just above the bed into the room below the hopper's top, over the whole width or its layer's ring, in
/// as many portions as that takes.
class BatchCharging {
 public:
  /// @throws Failure wrong_input where a batch's bulk volume (mass/density/0.55) exceeds the free volume above the
  /// stock line (MODEL 1)
  explicit BatchCharging(const Campaign& campaign);

  /// @param parcels all, by id  @param next_id first free id, advanced  @return parcels to add now
  std::vector<Parcel> pour(const std::vector<Parcel>& parcels, double surface, double time, std::uint64_t seed,
                           std::int64_t& next_id);

  /// Forgets the falling parcels that have come to rest (slower than 0.5 m/s) or are gone.
  void see_landed(const std::vector<Parcel>& parcels);

  [[nodiscard]] const ChargingState& state() const { return state_; }
  ChargingState& state() { return state_; }

  [[nodiscard]] nlohmann::json save() const;
  void load(const nlohmann::json& state);

 private:
  void begin_batch();
  /// |x| that the running batch is poured between, m (`charging.rings`).
  [[nodiscard]] std::array<double, 2> running_ring() const;

  const Campaign& campaign_;
  ChargingState state_;
};

}  // namespace cupola
