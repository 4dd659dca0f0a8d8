#include "stage_dem/pouring.hpp"

#include <algorithm>

#include "stage_dem/parcels.hpp"

namespace cupola {
namespace {

/// Downward speed at which poured parcels start, m/s: they fall from just above the bed.
constexpr double pouring_speed = 1.2;

}  // namespace

Pouring::Pouring(const Campaign& campaign, const std::vector<Parcel>& present)
    : campaign_(campaign), grid_(largest_diameter(campaign), period(campaign)) {
  for (const auto& parcel : present) {
    grid_.add(parcel.position, radius_.size());
    radius_.push_back(parcel.radius);
  }
}

double Pouring::room(const Campaign& campaign, double z, double radius) {
  // The narrowest half width a radius up or down takes care of sloping walls: w - r (1 + |slope|) <= w - r sqrt(1 +
  // slope^2).
  return std::min({campaign.half_width(z - radius), campaign.half_width(z), campaign.half_width(z + radius)}) - radius;
}

bool Pouring::place(double from, double to, std::int64_t id, const std::function<int(double x)>& choose,
                    RandomNumbers& random, int attempts) {
  const double half_depth = campaign_.scene.geometry.depth / 2;
  for (int attempt = 0; attempt < attempts; ++attempt) {
    const double z = from + (to - from) * random.next();
    const double half_width = campaign_.half_width(z);
    const double x = half_width * (2 * random.next() - 1);
    const double share_of_depth = 2 * random.next() - 1;
    const int species = choose(x);
    if (species < 0) continue;
    const double radius = campaign_.species[static_cast<std::size_t>(species)].parcel_diameter() / 2;
    if (std::abs(x) > room(campaign_, z, radius) || z < campaign_.bottom() + radius) continue;
    const Vector3 position{x, share_of_depth * (period(campaign_) > 0 ? half_depth : half_depth - radius), z};
    if (!free(position, radius)) continue;
    Parcel parcel = new_parcel(campaign_, id, species, position);
    parcel.velocity[2] = -pouring_speed;
    placed_.push_back(parcel);
    grid_.add(position, radius_.size());
    radius_.push_back(radius);
    return true;
  }
  return false;
}

bool Pouring::free(const Vector3& position, double radius) const {
  bool touched = false;
  grid_.near(position, [&](std::size_t other, const Vector3& way) {
    const double reach = 1.01 * (radius + radius_[other]);
    touched = touched || way[0] * way[0] + way[1] * way[1] + way[2] * way[2] < reach * reach;
  });
  return !touched;
}

}  // namespace cupola
