#include "physics/plan/dem_time_step.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "physics/closures/collision_time.hpp"
#include "physics/closures/rayleigh_time.hpp"

namespace cupola {
namespace {

double reference_time(const Contacts& contacts, const Species& species) {
  const double radius = species.parcel_diameter() / 2;
  if (contacts.model == Contacts::Model::hertz) {
    return rayleigh_time(radius, species.density, contacts.youngs_modulus, contacts.poisson_ratio);
  }
  const double mass = 4.0 / 3 * std::numbers::pi * radius * radius * radius * species.density;
  const auto pair = contacts.pairs.find(species.name + "-" + species.name);
  const double restitution = pair != contacts.pairs.end() ? pair->second.restitution : ContactPair{}.restitution;
  return collision_time(reduced_mass(mass, mass), species.coarse_graining * contacts.stiffness, restitution);
}

}  // namespace

DemTimeStep dem_time_step(const Campaign& campaign) {
  DemTimeStep result;
  result.reference_name = campaign.contacts.model == Contacts::Model::hertz ? "Rayleigh time" : "collision time";
  result.reference = std::numeric_limits<double>::infinity();
  for (const Species& species : campaign.species) {
    const double time = reference_time(campaign.contacts, species);
    if (time < result.reference) {
      result.reference = time;
      result.species = species.name;
    }
  }
  const double wanted = campaign.dem.time_step.value_or(campaign.dem.rayleigh_fraction * result.reference);
  // The tolerance keeps a stated step that divides the block from being halved by round-off.
  result.steps_per_block = std::max(1L, std::lround(std::ceil(campaign.dem.block / wanted * (1 - 1e-9))));
  result.step = campaign.dem.block / static_cast<double>(result.steps_per_block);
  return result;
}

}  // namespace cupola
