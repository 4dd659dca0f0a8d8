#pragma once
#include <cstdint>
#include <nlohmann/json.hpp>
#include <vector>

#include "stage_dem/engine.hpp"

namespace cupola {

/// Where parcels come from and go to, counted: mass is number times parcel mass, so that the ledger closes exactly.
class MassBooks {
 public:
  explicit MassBooks(const Campaign& campaign);

  using Counts = std::vector<std::int64_t>;  ///< parcels a species

  void put_in(const std::vector<Parcel>& parcels, bool charged);
  void take_out_raceway(std::size_t raceway, const Parcel& parcel) { ++count(raceway_[raceway], parcel); }
  void take_out_melted(const Parcel& parcel) { ++count(melted_, parcel); }
  void take_out_unmelted(const Parcel& parcel) { ++count(unmelted_, parcel); }

  [[nodiscard]] double mass(const Counts& counts) const;
  [[nodiscard]] const Counts& initial() const { return initial_; }
  [[nodiscard]] const Counts& charged() const { return charged_; }
  [[nodiscard]] const std::vector<Counts>& raceways() const { return raceway_; }
  [[nodiscard]] const Counts& melted() const { return melted_; }
  [[nodiscard]] const Counts& unmelted() const { return unmelted_; }

  /// Mass in minus out minus what is there, over mass in, from the parcels' own masses. 0 to round-off.
  [[nodiscard]] double residual(const std::vector<Parcel>& present) const;
  /// `ledger` of the result's summary.
  [[nodiscard]] nlohmann::json ledger(const std::vector<Parcel>& present) const;

  [[nodiscard]] nlohmann::json save() const;
  void load(const nlohmann::json& state);

  /// What went through the books since an earlier copy of them.
  [[nodiscard]] MassBooks since(const MassBooks& earlier) const;

 private:
  static std::int64_t& count(Counts& counts, const Parcel& parcel) {
    return counts[static_cast<std::size_t>(parcel.species)];
  }

  std::vector<double> parcel_mass_;
  Counts initial_, charged_, melted_, unmelted_;
  std::vector<Counts> raceway_;
};

}  // namespace cupola
