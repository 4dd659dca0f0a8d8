#include "stage_dem/raceway_removal.hpp"

#include <algorithm>

#include "stage_dem/random_numbers.hpp"

namespace cupola {
namespace {

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
    owed_[r] += raceway.dem_removal_rate * seconds;
    std::vector<const Parcel*> candidates;
    for (const auto& parcel : parcels)
      if (inside(raceway, parcel.position) && std::find(gone.begin(), gone.end(), parcel.id) == gone.end())
        candidates.push_back(&parcel);
    const auto stream = static_cast<std::uint64_t>(step) * owed_.size() + r;
    RandomNumbers random(seed, RandomNumbers::Use::raceway, stream);
    while (!candidates.empty()) {
      const auto drawn =
          candidates.begin() + static_cast<std::ptrdiff_t>(random.next() * static_cast<double>(candidates.size()));
      if (owed_[r] < (*drawn)->mass) break;
      owed_[r] -= (*drawn)->mass;
      books.take_out_raceway(r, **drawn);
      gone.push_back((*drawn)->id);
      candidates.erase(drawn);
    }
    const double most = raceway.dem_removal_rate * 1.0;  // a second's worth
    if (candidates.empty() && owed_[r] > most) {
      owed_[r] = most;
      starved_seconds_ += seconds;
    }
  }
  return gone;
}

void RacewayRemoval::load(const nlohmann::json& state) {
  state.at("owed").get_to(owed_);
  state.at("starved_seconds").get_to(starved_seconds_);
}

}  // namespace cupola
