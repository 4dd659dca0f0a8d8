#include "stage_dem/bed_surface.hpp"

#include <algorithm>
#include <cmath>

#include "stage_dem/parcels.hpp"

namespace cupola {

double bed_surface(const Campaign& campaign, const std::vector<Parcel>& parcels) {
  const double diameter = largest_diameter(campaign);
  double widest = 0;
  for (const auto& corner : campaign.scene.geometry.profile) widest = std::max(widest, corner[1]);
  const auto columns = static_cast<std::size_t>(std::max(1.0, std::floor(2 * widest / diameter)));
  std::vector<double> top(columns, campaign.bottom());
  for (const auto& parcel : parcels) {
    const auto& v = parcel.velocity;
    if (v[0] * v[0] + v[1] * v[1] + v[2] * v[2] > 1) continue;
    const double place = (parcel.position[0] + widest) / (2 * widest) * static_cast<double>(columns);
    const auto column = static_cast<std::size_t>(std::clamp(place, 0.0, static_cast<double>(columns) - 1));
    top[column] = std::max(top[column], parcel.position[2] + parcel.radius);
  }
  // Columns outside the slot at the surface's height hold nothing up there: they must not count.
  std::vector<double> sorted = top;
  std::sort(sorted.begin(), sorted.end());
  const double guess = sorted[sorted.size() / 2];
  std::vector<double> inside;
  for (std::size_t column = 0; column < columns; ++column) {
    const double x = (static_cast<double>(column) + 0.5) / static_cast<double>(columns) * 2 * widest - widest;
    if (std::abs(x) < campaign.half_width(guess) - diameter / 2) inside.push_back(top[column]);
  }
  if (inside.empty()) return guess;
  const auto middle = inside.begin() + static_cast<std::ptrdiff_t>(inside.size() / 2);
  std::nth_element(inside.begin(), middle, inside.end());
  return *middle;
}

double highest_top(const Campaign& campaign, const std::vector<Parcel>& parcels) {
  double highest = campaign.bottom();
  for (const auto& parcel : parcels) highest = std::max(highest, parcel.position[2] + parcel.radius);
  return highest;
}

}  // namespace cupola
