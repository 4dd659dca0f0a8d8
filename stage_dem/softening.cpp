#include "stage_dem/softening.hpp"

#include <algorithm>
#include <cmath>

#include "physics/closures/softening.hpp"

namespace cupola {
namespace {

const Species& kind(const Campaign& campaign, const Parcel& parcel) {
  return campaign.species[static_cast<std::size_t>(parcel.species)];
}

}  // namespace

double softened_radius(const Species& species, double factor) {
  return species.parcel_diameter() / 2 / std::cbrt(factor);
}

double present_factor(const Campaign& campaign, const Parcel& parcel) {
  return std::pow(kind(campaign, parcel).parcel_diameter() / 2 / parcel.radius, 3);
}

double soften(const Campaign& campaign, const Parcel& parcel, double temperature) {
  const Species& species = kind(campaign, parcel);
  if (!species.softening) return parcel.radius;
  return std::min(parcel.radius, softened_radius(species, volume_factor(temperature, *species.softening)));
}

double regrow(const Campaign& campaign, const Parcel& parcel, double temperature) {
  const Species& species = kind(campaign, parcel);
  if (!species.softening) return parcel.radius;
  const double wanted = softened_radius(species, volume_factor(temperature, *species.softening));
  return std::min(wanted, parcel.radius * (1 + regrowth_per_run));
}

bool melted(const Campaign& campaign, const Parcel& parcel, double temperature) {
  const Species& species = kind(campaign, parcel);
  return species.softening && temperature >= species.softening->melted;
}

}  // namespace cupola
