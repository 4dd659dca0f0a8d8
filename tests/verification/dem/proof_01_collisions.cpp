// Restitution of parcels and walls, and overlap under coarse graining against exact answers.
#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <vector>

#include "physics/closures/collision_time.hpp"
#include "physics/closures/rayleigh_time.hpp"
#include "tests/verification/dem/proof_scene.hpp"

namespace cupola::test {
namespace {

struct Stiffness {
  Contacts::Model model;
  double value;  ///< Pa (Hertz) or N/m of the grain (linear spring)
};

/// Three decades each; LIGGGHTS refuses Young's moduli below 5 MPa.
const std::vector<Stiffness> three_decades{
    {Contacts::Model::hertz, 5e6},         {Contacts::Model::hertz, 5e7},         {Contacts::Model::hertz, 5e8},
    {Contacts::Model::hertz, 5e9},         {Contacts::Model::linear_spring, 1e4}, {Contacts::Model::linear_spring, 1e5},
    {Contacts::Model::linear_spring, 1e6}, {Contacts::Model::linear_spring, 1e7}};

Campaign of_stiffness(const Stiffness& stiffness, double restitution) {
  Campaign campaign = one_species(0.1, 1000);
  campaign.contacts.model = stiffness.model;
  campaign.contacts.youngs_modulus = stiffness.value;
  campaign.contacts.wall_youngs_modulus = stiffness.value;
  campaign.contacts.stiffness = stiffness.value;
  for (auto& [name, pair] : campaign.contacts.pairs) pair = {restitution, 0, 0};
  return campaign;
}

TEST(Collisions, TwoParcelsReboundWithTheRestitutionPutIn) {
  for (const auto& stiffness : three_decades) {
    for (const double restitution : {0.2, 0.5, 0.9}) {
      const Campaign campaign = of_stiffness(stiffness, restitution);
      const double step = 0.01 * dem_time_step(campaign).reference;
      auto engine = box_engine(campaign, step);
      engine->add({new_parcel(campaign, 1, 0, {-0.0501, 0, 0.5}, {1, 0, 0}),
                   new_parcel(campaign, 2, 0, {0.0501, 0, 0.5}, {-1, 0, 0})});
      advance_until(*engine, 100,
                    [](const std::vector<Parcel>& all) { return all[1].position[0] - all[0].position[0] > 0.1002; });
      const auto after = everyone(*engine);
      EXPECT_NEAR((after[1].velocity[0] - after[0].velocity[0]) / 2, restitution, 0.01)
          << (stiffness.model == Contacts::Model::hertz ? "hertz " : "linear ") << stiffness.value;
    }
  }
}

TEST(Collisions, AParcelReboundsFromAWallWithTheRestitutionPutIn) {
  // A side wall, so that gravity acts along it.
  for (const auto& stiffness : three_decades) {
    for (const double restitution : {0.2, 0.5, 0.9}) {
      const Campaign campaign = of_stiffness(stiffness, restitution);
      auto engine = box_engine(campaign, 0.01 * dem_time_step(campaign).reference);
      engine->add({new_parcel(campaign, 1, 0, {0.4499, 0, 0.6}, {1, 0, 0})});
      advance_until(*engine, 100, [](const std::vector<Parcel>& all) { return all[0].position[0] < 0.4498; });
      EXPECT_NEAR(-everyone(*engine)[0].velocity[0], restitution, 0.01)
          << (stiffness.model == Contacts::Model::hertz ? "hertz " : "linear ") << stiffness.value;
    }
  }
}

TEST(Collisions, RelativeOverlapOfALinearSpringIsThatOfTheGrainForAnyCoarseGraining) {
  // overlap = v sqrt(m12/K) exp(-x atan(1/x)) with x = -ln(e)/pi, m12 ~ n^3 and K ~ n: over the radius the same for all
  // n.
  constexpr double restitution = 0.5, speed = 2;
  std::vector<double> relative;
  for (const double n : {1.0, 2.0, 4.0, 8.0}) {
    Campaign campaign = of_stiffness({Contacts::Model::linear_spring, 1e4}, restitution);
    campaign.species[0].diameter = 0.0125;
    campaign.species[0].coarse_graining = n;
    const double radius = campaign.species[0].parcel_diameter() / 2;
    auto engine = box_engine(campaign, 0.002 * dem_time_step(campaign).reference);
    engine->add({new_parcel(campaign, 1, 0, {-1.0001 * radius, 0, 0.5}, {speed / 2, 0, 0}),
                 new_parcel(campaign, 2, 0, {1.0001 * radius, 0, 0.5}, {-speed / 2, 0, 0})});
    double overlap = 0;
    advance_until(*engine, 2, [&](const std::vector<Parcel>& all) {
      const double now = 2 * radius - (all[1].position[0] - all[0].position[0]);
      overlap = std::max(overlap, now);
      return all[1].velocity[0] > all[0].velocity[0];
    });
    relative.push_back(overlap / radius);
    const double mass = parcel_mass(campaign.species[0]);
    const double x = -std::log(restitution) / M_PI;
    const double exact = speed * std::sqrt(mass / 2 / (n * 1e4)) * std::exp(-x * std::atan(1 / x));
    EXPECT_NEAR(overlap / exact, 1, 0.005) << n;
  }
  for (const double value : relative) EXPECT_NEAR(value / relative.front(), 1, 1e-3);
}

}  // namespace
}  // namespace cupola::test
