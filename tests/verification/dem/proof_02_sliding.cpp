// A sphere that slides on a floor comes to roll: u = 5/7 u0 after 2 u0/(7 mu g).
#include <gtest/gtest.h>

#include <cmath>

#include "tests/verification/dem/proof_scene.hpp"

namespace cupola::test {
namespace {

TEST(Sliding, ASphereComesToRollAtFiveSeventhsOfItsSpeed) {
  for (const auto model : {Contacts::Model::linear_spring, Contacts::Model::hertz}) {
    for (const double friction : {0.2, 0.5, 1.0}) {
      Campaign campaign = one_species(0.02, 2500);
      campaign.contacts.model = model;
      campaign.contacts.stiffness = 1e4;
      campaign.contacts.wall_youngs_modulus = campaign.contacts.youngs_modulus;
      campaign.contacts.pairs["coke-wall"] = {0.5, friction, 0};
      auto engine = box_engine(campaign, 0.02 * dem_time_step(campaign).reference);
      // At rest on the floor first, so that it does not bounce; then pushed off by a new start.
      engine->add({new_parcel(campaign, 1, 0, {-0.4, 0, 0.01}, {})});
      advance_until(*engine, 2000, [](const auto& all) { return std::abs(all[0].velocity[2]) < 1e-6; });
      const double height = everyone(*engine)[0].position[2];
      auto pushed = box_engine(campaign, 0.02 * dem_time_step(campaign).reference);
      pushed->add({new_parcel(campaign, 1, 0, {-0.4, 0, height}, {1, 0, 0})});
      const double step = 0.02 * dem_time_step(campaign).reference;
      const double exact = 2.0 / (7 * friction * 9.81);
      advance_until(*pushed, std::max(1L, std::lround(exact / 200 / step)), [](const auto& all) {
        return all[0].velocity[0] - all[0].angular_velocity[1] * all[0].radius < 0.01;
      });
      // The slip falls linearly from 1 to 0; the last hundredth of it is the tangential spring's.
      EXPECT_NEAR(static_cast<double>(pushed->step()) * step / exact, 1, 0.02) << friction;
      pushed->advance(std::lround(0.5 * exact / step));
      const auto rolling = everyone(*pushed)[0];
      EXPECT_NEAR(rolling.velocity[0], 5.0 / 7, 0.01) << friction;
      EXPECT_NEAR(rolling.angular_velocity[1] * rolling.radius, 5.0 / 7, 0.01) << friction;
    }
  }
}

}  // namespace
}  // namespace cupola::test
