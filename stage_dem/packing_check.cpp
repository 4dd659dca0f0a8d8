#include "stage_dem/packing_check.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <unordered_set>

#include "schemas/failure.hpp"
#include "stage_dem/bed_watch.hpp"

namespace cupola {
namespace {

constexpr const char* cure = "take the packing that the episode before wrote, or begin without one";

std::string place(const Parcel& parcel) {
  return fmt::format("{:.4g} {:.4g} {:.4g} m", parcel.position[0], parcel.position[1], parcel.position[2]);
}

[[noreturn]] void refuse(const Parcel& parcel, const std::string& what, const std::string& file) {
  throw Failure(ExitCode::wrong_input, fmt::format("{}: parcel {} {}: {}", file, parcel.id, what, cure))
      .at("parcel", std::to_string(parcel.id))
      .at("file", file);
}

void check_numbers(const Campaign& campaign, const Parcel& parcel, const std::string& file) {
  if (parcel.species < 0 || parcel.species >= static_cast<int>(campaign.species.size()))
    refuse(parcel, fmt::format("is of species {}, but the campaign has {}", parcel.species, campaign.species.size()),
           file);
  bool finite = true;
  for (const Vector3* vector : {&parcel.position, &parcel.velocity, &parcel.angular_velocity})
    for (const double component : *vector) finite = finite && std::isfinite(component);
  if (!finite) refuse(parcel, "has a place or velocity that is no number", file);
  if (!(parcel.radius > 0) || !(parcel.mass > 0) || !std::isfinite(parcel.radius) || !std::isfinite(parcel.mass))
    refuse(parcel, fmt::format("has a radius of {} m and a mass of {} kg", parcel.radius, parcel.mass), file);
}

}  // namespace

void check_packing(const Campaign& campaign, const std::vector<Parcel>& parcels, const std::string& file) {
  std::unordered_set<std::int64_t> seen;
  for (const Parcel& parcel : parcels) {
    check_numbers(campaign, parcel, file);
    if (parcel.id < 1 || !seen.insert(parcel.id).second) refuse(parcel, "is there twice, or has no valid id", file);
    const double overlap = wall_overlap(campaign, parcel);
    if (overlap > 1 || parcel.position[2] > campaign.hopper_top())
      refuse(parcel, fmt::format("lies outside the furnace, at {}", place(parcel)), file);
    if (overlap > campaign.dem.limits.wall_overlap)
      refuse(parcel,
             fmt::format("overlaps a wall by {:.2f} of its radius, at {} (dem.limits.wall_overlap is {})", overlap,
                         place(parcel), campaign.dem.limits.wall_overlap),
             file);
  }
  const Overlap deepest = deepest_overlap(campaign, parcels);
  if (deepest.depth > campaign.dem.limits.overlap) {
    const Parcel& one = parcels[deepest.first];
    refuse(one,
           fmt::format("overlaps parcel {} by {:.2f} of the radius, at {} (dem.limits.overlap is {})",
                       parcels[deepest.second].id, deepest.depth, place(one), campaign.dem.limits.overlap),
           file);
  }
}

}  // namespace cupola
