#include "physics/plan/dem_time_step.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "physics/closures/collision_time.hpp"
#include "physics/closures/rayleigh_time.hpp"
#include "schemas/failure.hpp"

namespace cupola {
namespace {

double parcel_mass(const Species& species) {
  return std::numbers::pi / 6 * std::pow(species.parcel_diameter(), 3) * species.density;
}

/// Collision time of two parcels with linear springs (docs: contacts), s.
double pair_collision_time(const Campaign& campaign, std::size_t first, std::size_t second) {
  const Species& one = campaign.species[first];
  const Species& other = campaign.species[second];
  const auto pair = campaign.contacts.pairs.find(one.name + "-" + other.name);
  const double restitution =
      pair != campaign.contacts.pairs.end() ? pair->second.restitution : ContactPair{}.restitution;
  return collision_time(
      reduced_mass(parcel_mass(one), parcel_mass(other)),
      parcel_pair_stiffness(campaign.contacts.stiffness, campaign.contacts.stiffness_factor(one.coarse_graining),
                            campaign.contacts.stiffness_factor(other.coarse_graining)),
      restitution);
}

}  // namespace

DemTimeStep dem_time_step(const Campaign& campaign) {
  DemTimeStep result;
  result.reference_name = campaign.contacts.model == Contacts::Model::hertz ? "Rayleigh time" : "collision time";
  result.reference = std::numeric_limits<double>::infinity();
  const Contacts& contacts = campaign.contacts;
  const auto see = [&](double time, const std::string& species) {
    if (time >= result.reference) return;
    result.reference = time;
    result.species = species;
  };
  for (std::size_t i = 0; i < campaign.species.size(); ++i) {
    const Species& species = campaign.species[i];
    if (contacts.model == Contacts::Model::hertz) {
      see(rayleigh_time(species.parcel_diameter() / 2, species.density, contacts.youngs_modulus,
                        contacts.poisson_ratio),
          species.name);
      continue;
    }
    // Walls are as stiff as the parcel and heavier than any other: their collisions take longer.
    for (std::size_t j = i; j < campaign.species.size(); ++j)
      see(pair_collision_time(campaign, i, j), j == i ? species.name : species.name + "-" + campaign.species[j].name);
  }
  const double wanted = campaign.dem.time_step.value_or(campaign.dem.rayleigh_fraction * result.reference);
  const double stable = largest_stable_fraction * result.reference;
  if (wanted > stable * (1 + 1e-9)) {
    throw Failure(ExitCode::wrong_input,
                  fmt::format("dem.time_step: {:.4g} s is above the stable step of {:.4g} s, {:.0f} % of the {} of {} "
                              "parcels, {:.4g} s",
                              wanted, stable, 100 * largest_stable_fraction, result.reference_name, result.species,
                              result.reference))
        .at("key", "dem.time_step")
        .advise("dem.time_step", fmt::format("auto, or at most {:.4g} s", stable));
  }
  // The tolerance keeps a stated step that divides the block from being halved by round-off.
  result.steps_per_block = std::max(1L, std::lround(std::ceil(campaign.dem.block / wanted * (1 - 1e-9))));
  result.step = campaign.dem.block / static_cast<double>(result.steps_per_block);
  return result;
}

}  // namespace cupola
