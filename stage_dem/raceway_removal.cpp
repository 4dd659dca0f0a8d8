#include "stage_dem/raceway_removal.hpp"

#include <algorithm>
#include <limits>

#include "stage_dem/parcels.hpp"
#include "stage_dem/random_numbers.hpp"

namespace cupola {
namespace {

/// Material volume that fills a raceway's box beyond its void, m3; without limit where no void is kept.
double surplus(const Campaign& campaign, const Raceway& raceway, const std::vector<const Parcel*>& inside) {
  if (raceway.removal == Raceway::Removal::rate) return std::numeric_limits<double>::infinity();
  double volume = -(1 - raceway.void_fraction);
  for (std::size_t k = 0; k < 3; ++k) volume *= raceway.box[1][k] - raceway.box[0][k];
  for (const auto* parcel : inside) volume += material_volume(campaign, *parcel);
  return volume;
}

bool inside(const Raceway& raceway, const Vector3& point) {
  for (std::size_t k = 0; k < 3; ++k)
    if (point[k] < raceway.box[0][k] || point[k] > raceway.box[1][k]) return false;
  return true;
}

}  // namespace

RacewayRemoval::RacewayRemoval(const Campaign& campaign) : campaign_(campaign), owed_(campaign.raceways.size(), 0.0) {}

std::vector<std::int64_t> RacewayRemoval::remove(const std::vector<Parcel>& parcels, double seconds, std::uint64_t seed,
                                                 long step, MassBooks& books) {
  std::vector<std::int64_t> gone;
  for (std::size_t r = 0; r < owed_.size(); ++r) {
    const Raceway& raceway = campaign_.raceways[r];
    std::vector<const Parcel*> candidates;
    for (const auto& parcel : parcels)
      if (inside(raceway, parcel.position) && std::find(gone.begin(), gone.end(), parcel.id) == gone.end())
        candidates.push_back(&parcel);
    const bool keep_void = raceway.removal == Raceway::Removal::keep_void;
    owed_[r] += raceway.dem_removal_rate * seconds;
    double too_much = surplus(campaign_, raceway, candidates);
    const auto stream = static_cast<std::uint64_t>(step) * owed_.size() + r;
    RandomNumbers random(seed, RandomNumbers::Use::raceway, stream);
    while (!candidates.empty()) {
      const auto drawn =
          candidates.begin() + static_cast<std::ptrdiff_t>(random.next() * static_cast<double>(candidates.size()));
      const double volume = material_volume(campaign_, **drawn);
      if (owed_[r] < (*drawn)->mass || too_much < volume) break;
      too_much -= volume;
      owed_[r] -= (*drawn)->mass;
      books.take_out_raceway(r, **drawn);
      gone.push_back((*drawn)->id);
      candidates.erase(drawn);
    }
    const double most = raceway.dem_removal_rate * 1.0;  // a second's worth
    if ((keep_void || candidates.empty()) && owed_[r] > most) {
      owed_[r] = most;
      if (!keep_void) starved_seconds_ += seconds;
    }
  }
  return gone;
}

void RacewayRemoval::load(const nlohmann::json& state) {
  state.at("owed").get_to(owed_);
  state.at("starved_seconds").get_to(starved_seconds_);
}

}  // namespace cupola
