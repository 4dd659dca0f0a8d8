// A sphere that slides over a floor until it rolls; blocks of any length, since each begins with a full set-up.
#include <gtest/gtest.h>

#include <cmath>

#include "tests/verification/dem/proof_scene.hpp"

namespace cupola::test {
namespace {

struct Slide {
  double speed_rolling = 0;  ///< m/s, when it has rolled for a while
  double deceleration = 0;   ///< of the slip while it slides, over the exact 7/2 mu g
  double time = 0;           ///< s, from the first block's end to where the falling slip reaches nought
  double exact_time = 0;     ///< s, slip after the first block over 7/2 mu g
};

/// Without spin at first: u = u0 - mu g t, omega r = 5/2 mu g t, until the slip u - omega r is gone and u = 5/7 u0: at
/// t = 2 u0/(7 mu g), where friction is at Coulomb's bound from the beginning.  In the first steps the tangential
/// spring is still loaded, and its dashpot sees the whole slip: time is counted from the end of the first block.
Slide slide(Contacts::Model model, double friction, long steps_a_block) {
  constexpr double gravity = 9.81, speed = 1, radius = 0.05;
  Campaign campaign = one_species(2 * radius, 2500);
  campaign.scene.geometry.profile = {{0, 0.8}, {1, 0.8}};
  campaign.contacts.model = model;
  campaign.contacts.youngs_modulus = campaign.contacts.wall_youngs_modulus = 5e7;
  campaign.contacts.stiffness = 1e6;
  for (auto& [name, pair] : campaign.contacts.pairs) pair = {0.5, friction, 0};
  Parcel parcel = new_parcel(campaign, 1, 0, {-0.6, 0, radius}, {speed, 0, 0});
  // Where its weight is carried, so that it does not bounce.
  const double weight = parcel.mass * gravity;
  const double modulus = campaign.contacts.youngs_modulus / 2 / (1 - std::pow(campaign.contacts.poisson_ratio, 2));
  parcel.position[2] -= model == Contacts::Model::hertz ? std::cbrt(std::pow(0.75 * weight / modulus, 2) / radius)
                                                        : weight / campaign.contacts.stiffness;
  const double step = 0.03 * dem_time_step(campaign).reference;
  auto engine = box_engine(campaign, step);
  engine->add({parcel});
  const double block = static_cast<double>(steps_a_block) * step;
  const double exact_deceleration = 3.5 * friction * gravity;
  Slide result;
  double first = 0;
  double before = 0;
  const double exact = 2 * speed / (7 * friction * gravity);
  for (int blocks = 1; blocks * block < 2 * exact + 0.02; ++blocks) {
    engine->advance(steps_a_block);
    const Parcel now = everyone(*engine)[0];
    const double slip = now.velocity[0] - radius * now.angular_velocity[1];
    if (blocks == 1) {
      first = before = slip;
    } else if (slip > 0.1 * speed) {
      result.deceleration = (first - slip) / ((blocks - 1) * block) / exact_deceleration;
      result.time = (blocks - 1) * block + slip / ((before - slip) / block);
    }
    before = slip;
    result.speed_rolling = now.velocity[0];
  }
  result.exact_time = first / exact_deceleration;
  EXPECT_NEAR(before, 0, 1e-3 * speed);
  return result;
}

TEST(Rolling, BeginsAtFiveSeventhsOfTheSpeedWhenTheExactTimeIsOver) {
  for (const auto model : {Contacts::Model::hertz, Contacts::Model::linear_spring})
    for (const double friction : {0.2, 0.5, 0.9})
      for (const long steps : {10L, 40L, 140L}) {
        const Slide found = slide(model, friction, steps);
        const auto which = testing::Message() << (model == Contacts::Model::hertz ? "hertz" : "linear") << ", friction "
                                              << friction << ", blocks of " << steps << " steps";
        EXPECT_NEAR(found.deceleration, 1, 1e-3) << which;
        EXPECT_NEAR(found.time / found.exact_time, 1, 1e-3) << which;
        EXPECT_NEAR(found.speed_rolling, 5.0 / 7, 1e-3) << which;
      }
}

}  // namespace
}  // namespace cupola::test
