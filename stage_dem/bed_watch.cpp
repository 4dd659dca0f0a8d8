#include "stage_dem/bed_watch.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "stage_dem/neighbour_grid.hpp"
#include "stage_dem/parcels.hpp"

namespace cupola {
namespace {

double norm(const Vector3& v) { return std::sqrt(v[0] * v[0] + v[1] * v[1] + v[2] * v[2]); }

constexpr double fast_speed = 5;

/// Distance of a point in the plane (x >= 0, z) from a side wall's straight piece, m.
double distance(double x, double z, const std::array<double, 2>& low, const std::array<double, 2>& high) {
  const double dz = high[0] - low[0];
  const double dx = high[1] - low[1];
  const double along = std::clamp(((z - low[0]) * dz + (x - low[1]) * dx) / (dz * dz + dx * dx), 0.0, 1.0);
  return std::hypot(z - low[0] - along * dz, x - low[1] - along * dx);
}

/// Distance of a parcel's centre from the nearest wall, m, negative beyond a wall.
double distance_from_walls(const Campaign& campaign, const Vector3& point) {
  const auto& geometry = campaign.scene.geometry;
  const double x = std::abs(point[0]);
  double nearest = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < geometry.profile.size(); ++i) {
    const auto& low = geometry.profile[i];
    const std::array<double, 2> hopper{campaign.hopper_top(), low[1]};
    const auto& high = i + 1 < geometry.profile.size() ? geometry.profile[i + 1] : hopper;
    if (high[0] > low[0]) nearest = std::min(nearest, distance(x, point[2], low, high));
  }
  if (x > campaign.half_width(point[2])) nearest = -nearest;
  nearest = std::min(nearest, point[2] - campaign.bottom());
  if (geometry.sides == Geometry::Sides::walls) nearest = std::min(nearest, geometry.depth / 2 - std::abs(point[1]));
  return nearest;
}

}  // namespace

double wall_overlap(const Campaign& campaign, const Parcel& parcel) {
  return 1 - distance_from_walls(campaign, parcel.position) / parcel.radius;
}

double largest_wall_overlap(const Campaign& campaign, const std::vector<Parcel>& parcels) {
  double largest = 0;
  for (const auto& parcel : parcels) largest = std::max(largest, wall_overlap(campaign, parcel));
  return largest;
}

double largest_overlap(const Campaign& campaign, const std::vector<Parcel>& parcels, MPI_Comm communicator) {
  int rank = 0;
  int ranks = 1;
  MPI_Comm_rank(communicator, &rank);
  MPI_Comm_size(communicator, &ranks);
  double largest =
      deepest_overlap(campaign, parcels, static_cast<std::size_t>(rank), static_cast<std::size_t>(ranks)).depth;
  MPI_Allreduce(MPI_IN_PLACE, &largest, 1, MPI_DOUBLE, MPI_MAX, communicator);
  return largest;
}

Overlap deepest_overlap(const Campaign& campaign, const std::vector<Parcel>& parcels, std::size_t first,
                        std::size_t stride) {
  NeighbourGrid grid(largest_diameter(campaign), period(campaign));
  for (std::size_t i = 0; i < parcels.size(); ++i) grid.add(parcels[i].position, i);
  Overlap deepest;
  for (std::size_t i = first; i < parcels.size(); i += stride)
    grid.near(parcels[i].position, [&](std::size_t j, const Vector3& way) {
      if (j == i) return;
      const double depth =
          (parcels[i].radius + parcels[j].radius - norm(way)) / std::min(parcels[i].radius, parcels[j].radius);
      if (depth > deepest.depth) deepest = {depth, i, j};
    });
  return deepest;
}

BedMotion bed_motion(const std::vector<Parcel>& parcels, const std::set<std::int64_t>& falling, double seconds) {
  BedMotion motion;
  std::size_t counted = 0;
  for (const auto& parcel : parcels) {
    if (norm(parcel.velocity) > fast_speed) ++motion.fast;
    if (falling.contains(parcel.id)) continue;
    motion.speed += norm(parcel.displacement) / seconds;
    motion.downwards -= parcel.displacement[2] / seconds;
    ++counted;
  }
  if (counted > 0) {
    motion.speed /= static_cast<double>(counted);
    motion.downwards /= static_cast<double>(counted);
  }
  return motion;
}

bool in_interior(const Campaign& campaign, const Vector3& point, double surface) {
  const double diameter = largest_diameter(campaign);
  const double away = 1.5 * diameter;
  if (std::abs(point[0]) > campaign.half_width(point[2]) - away) return false;
  if (period(campaign) == 0 && std::abs(point[1]) > campaign.scene.geometry.depth / 2 - away) return false;
  if (point[2] < campaign.bottom() + away || point[2] > surface - away) return false;
  return std::none_of(campaign.raceways.begin(), campaign.raceways.end(), [&](const Raceway& raceway) {
    bool inside = true;
    for (std::size_t k = 0; k < 3; ++k)
      inside = inside && point[k] > raceway.box[0][k] - away && point[k] < raceway.box[1][k] + away;
    return inside;
  });
}

}  // namespace cupola
