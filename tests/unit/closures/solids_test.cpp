#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "physics/closures/collision_time.hpp"
#include "physics/closures/rayleigh_time.hpp"
#include "physics/closures/softening.hpp"

namespace cupola {
namespace {

TEST(Softening, VolumeFactorOfThePaper) {
  const Softening ore{1475, 1675};
  EXPECT_DOUBLE_EQ(volume_factor(300, ore), 1);
  EXPECT_DOUBLE_EQ(volume_factor(1475, ore), 1);
  EXPECT_DOUBLE_EQ(volume_factor(1575, ore), 1.28125);
  EXPECT_DOUBLE_EQ(volume_factor(1675, ore), 1.5625);
  EXPECT_DOUBLE_EQ(volume_factor(2600, ore), 1.5625);
  for (double t = 1400; t < 1750; t += 1) EXPECT_LE(volume_factor(t, ore), volume_factor(t + 1, ore));
}

TEST(RayleighTime, CokeParcelOfThePaper) { EXPECT_NEAR(rayleigh_time(0.088, 800, 5e7, 0.25), 1.906e-3, 5e-7); }

TEST(RayleighTime, GrowsWithRadius) {
  EXPECT_DOUBLE_EQ(rayleigh_time(0.2, 800, 5e7, 0.25), 2 * rayleigh_time(0.1, 800, 5e7, 0.25));
}

// Integrates the spring and dashpot of seed 004 through one collision.
TEST(CollisionTime, IntegratedCollisionHasThisDurationAndRestitution) {
  const double mass = reduced_mass(3.3e-5, 3.3e-5), stiffness = 1e4, e = 0.5;
  const double duration = collision_time(mass, stiffness, e), damping = collision_damping(mass, stiffness, e);
  double overlap = 0, speed = 1;
  const double h = duration / 200000;
  int steps = 0;
  const auto acceleration = [&](double x, double v) { return -(stiffness * x + damping * v) / mass; };
  while (overlap >= 0 && steps < 300000) {
    const double x1 = overlap + h / 2 * speed, v1 = speed + h / 2 * acceleration(overlap, speed);
    overlap += h * v1;
    speed += h * acceleration(x1, v1);
    ++steps;
  }
  EXPECT_NEAR(steps * h / duration, 1, 1e-4);
  EXPECT_NEAR(-speed, e, 1e-4);
}

TEST(CollisionTime, ElasticLimitAndCoarseGraining) {
  EXPECT_NEAR(collision_time(1, 1, 1), M_PI, 1e-15);
  // A parcel of n grains across: n^3 of the mass, n of the stiffness, so n of the time.
  EXPECT_NEAR(collision_time(27 * 2e-6, 3 * 1e4, 0.5) / collision_time(2e-6, 1e4, 0.5), 3, 1e-14);
  EXPECT_EQ(collision_damping(1, 1, 1), 0);
}

}  // namespace
}  // namespace cupola
