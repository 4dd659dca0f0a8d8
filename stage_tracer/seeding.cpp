#include "stage_tracer/seeding.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "schemas/failure.hpp"
#include "stage_tracer/random.hpp"

namespace cupola {
namespace {

std::int64_t bed_cell_at(const CellLocator& locator, const std::vector<bool>& bed, const Vector3& point,
                         std::int64_t guess) {
  const std::int64_t cell = locator.find(point, guess);
  return cell >= 0 && bed[cell] ? cell : -1;
}

/// Uniform in a ball.
Vector3 point_in_ball(const Vector3& centre, double radius, const std::array<double, 4>& uniform) {
  const double distance = radius * std::cbrt(uniform[0]);
  const double cosine = 2 * uniform[1] - 1;
  const double sine = std::sqrt(1 - cosine * cosine);
  const double angle = 2 * std::numbers::pi * uniform[2];
  return {centre[0] + distance * sine * std::cos(angle), centre[1] + distance * sine * std::sin(angle),
          centre[2] + distance * cosine};
}

}  // namespace

int tracers_per_parcel(const Campaign& campaign, const CellLocator& locator, const std::vector<bool>& bed,
                       const Packing& packing) {
  const auto cells = static_cast<double>(std::count(bed.begin(), bed.end(), true));
  double parcels = 0;
  std::int64_t guess = -1;
  for (const Vector3& position : packing.position) {
    const std::int64_t cell = bed_cell_at(locator, bed, position, guess);
    if (cell < 0) continue;
    guess = cell;
    ++parcels;
  }
  if (parcels == 0) {
    throw Failure(ExitCode::wrong_input,
                  "no parcel of the DEM packing lies in the bed; there is nothing to seed tracers from");
  }
  const double split = std::ceil(campaign.tracer.tracers_per_cell * cells / parcels);
  return static_cast<int>(std::clamp(split, 1.0, static_cast<double>(tracer_ids_per_parcel - 1)));
}

Tracers seed_tracers(const Campaign& campaign, const CellLocator& locator, const PathField& paths,
                     const std::vector<bool>& bed, const Packing& packing, int split, std::uint64_t seed, int rank,
                     int ranks) {
  Tracers tracers;
  std::int64_t guess = -1;
  for (std::size_t p = 0; p < packing.id.size(); ++p) {
    const std::int64_t centre_cell = bed_cell_at(locator, bed, packing.position[p], guess);
    if (centre_cell < 0) continue;
    guess = centre_cell;
    const double volume = packing.mass[p] / campaign.species[packing.species[p]].density / split;
    for (int j = 0; j < split; ++j) {
      const std::int64_t id = packing.id[p] * tracer_ids_per_parcel + j;
      if (rank_of(id, ranks) != rank) continue;
      Vector3 position = packing.position[p];
      std::int64_t cell = centre_cell;
      if (split > 1) {
        const auto uniform = random_uniform(seed, RandomUse::seeding, static_cast<std::uint64_t>(id));
        const Vector3 jittered = point_in_ball(position, packing.radius[p], uniform);
        const std::int64_t jittered_cell = bed_cell_at(locator, bed, jittered, centre_cell);
        if (jittered_cell >= 0) {
          position = jittered;
          cell = jittered_cell;
        }
      }
      tracers.add(id, packing.species[p], paths.locate_in(cell, position), volume, draw_life(seed, id));
    }
  }
  return tracers;
}

}  // namespace cupola
