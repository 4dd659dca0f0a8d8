#include "stage_dem/dem_limits.hpp"

#include <fmt/format.h>

#include "physics/plan/charge.hpp"
#include "physics/plan/dem_time_step.hpp"
#include "schemas/failure.hpp"

namespace cupola {
namespace {

std::string half_the_fraction(const Campaign& campaign) {
  return fmt::format("{:.3g}", dem_time_step(campaign).fraction() / 2);
}

[[noreturn]] void too_deep(const Campaign& campaign, const std::string& what, double overlap, double limit,
                           const std::string& key, double modulus, long step) {
  const bool hertz = campaign.contacts.model == Contacts::Model::hertz;
  throw Failure(ExitCode::diverged, fmt::format("{} overlap by {:.2f} of the radius, the limit dem.limits.{} is {}: "
                                                "the contacts are too soft for this bed, or the time step is too long",
                                                what, overlap, key, limit))
      .at("step", std::to_string(step))
      .advise(hertz ? (key == "overlap" ? "contacts.youngs_modulus" : "contacts.wall_youngs_modulus")
                    : "contacts.stiffness",
              fmt::format("{:.3g} {}", 2 * modulus, hertz ? "Pa" : "N/m"))
      .advise("dem.rayleigh_fraction", half_the_fraction(campaign));
}

}  // namespace

double creep_over_descent(const Campaign& campaign, double creep_speed) {
  const double descent = campaign.descent_rate * dem_speed_up(campaign, charge_of(campaign));
  return descent > 0 ? creep_speed / descent : 0;
}

void check_overlaps(const Campaign& campaign, double overlap, double wall_overlap, long step) {
  const Contacts& contacts = campaign.contacts;
  const bool hertz = contacts.model == Contacts::Model::hertz;
  const DemLimits& limits = campaign.dem.limits;
  if (overlap > limits.overlap)
    too_deep(campaign, "two parcels", overlap, limits.overlap, "overlap",
             hertz ? contacts.youngs_modulus : contacts.stiffness, step);
  if (wall_overlap > limits.wall_overlap)
    too_deep(campaign, "a parcel and a wall", wall_overlap, limits.wall_overlap, "wall_overlap",
             hertz ? contacts.wall_youngs_modulus : contacts.stiffness, step);
}

void check_creep(const Campaign& campaign, double creep_speed, long step) {
  const double share = creep_over_descent(campaign, creep_speed);
  if (share <= campaign.dem.limits.creep) return;
  throw Failure(ExitCode::diverged,
                fmt::format("the bed at rest sinks at {:.3g} m/s, {:.2f} of its descent in the DEM stage; the limit "
                            "dem.limits.creep is {}: the time step is too long for the rolling friction",
                            creep_speed, share, campaign.dem.limits.creep))
      .at("step", std::to_string(step))
      .advise("dem.rayleigh_fraction", half_the_fraction(campaign));
}

}  // namespace cupola
