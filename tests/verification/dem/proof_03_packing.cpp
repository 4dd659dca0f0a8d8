// Packing fraction of a poured bed, away from the walls.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "tests/verification/dem/proof_scene.hpp"

namespace cupola::test {
namespace {

/// A bed of some hundred parcels poured into a box of 9 by 6 diameters (periodic along y) and left to settle; packing
/// more than three diameters from the side walls, two from the floor and 1.5 from the surface.
double packing(double diameter, double coarse_graining, const ContactPair& pair, Contacts::Rolling rolling) {
  Campaign campaign = one_species(diameter, 2500);
  campaign.species[0].coarse_graining = coarse_graining;
  const double d = campaign.species[0].parcel_diameter();
  campaign.scene.geometry.depth = 6 * d;
  campaign.scene.geometry.sides = Geometry::Sides::periodic;
  campaign.scene.geometry.profile = {{0, 4.5 * d}, {26 * d, 4.5 * d}};
  campaign.contacts.rolling_model = rolling;
  for (auto& [name, value] : campaign.contacts.pairs) value = pair;
  campaign.contacts.wall_youngs_modulus = campaign.contacts.youngs_modulus;
  const double step = 0.1 * dem_time_step(campaign).reference;
  auto engine = box_engine(campaign, step);
  engine->add(poured(campaign, 26 * d, 620));
  const double fall = std::sqrt(2 * 26 * d / 9.81);
  engine->advance(std::lround(1.5 * fall / step));
  advance_until(*engine, std::lround(0.2 * fall / step), [&](const auto& all) {
    double fastest = 0;
    for (const auto& parcel : all) fastest += std::abs(parcel.velocity[2]) / static_cast<double>(all.size());
    return fastest < 0.01 * std::sqrt(9.81 * d);
  });
  const auto all = everyone(*engine);
  double top = 0;
  for (const auto& parcel : all) top += 2 * parcel.position[2] / static_cast<double>(all.size());
  return packing_fraction(campaign, all, {-1.5 * d, -3 * d, 2 * d}, {1.5 * d, 3 * d, top - 1.5 * d});
}

TEST(Packing, GrainsWithoutRollingFrictionPackRandomly) {
  double before = 1;
  for (const double friction : {0.1, 0.3}) {
    const double found = packing(0.05, 1, {0.5, friction, 0}, Contacts::Rolling::none);
    RecordProperty("packing_at_friction_" + std::to_string(friction).substr(0, 3), std::to_string(found));
    EXPECT_GT(found, 0.58) << friction;
    EXPECT_LT(found, 0.64) << friction;
    EXPECT_LT(found, before);
    before = found;
  }
}

TEST(Packing, ParcelsPackAsGrainsDo) {
  const double grains = packing(0.05, 1, {0.5, 0.2, 0}, Contacts::Rolling::none);
  EXPECT_NEAR(packing(0.05, 4, {0.5, 0.2, 0}, Contacts::Rolling::none), grains, 0.01);
}

TEST(Packing, TheFurnacesConstantsGiveALooserBed) {
  const double found = packing(0.05, 1, {0.5, 0.9, 0.5}, Contacts::Rolling::cdt);
  RecordProperty("packing", std::to_string(found));
  EXPECT_GT(found, 0.50);
  EXPECT_LT(found, 0.59);
}

}  // namespace
}  // namespace cupola::test
