// What forces give, parcels have: on any number of ranks.
#include <gtest/gtest.h>

#include <cmath>

#include "tests/verification/dem/proof_scene.hpp"

namespace cupola::test {
namespace {

TEST(Impulse, OfAThousandStepsIsTheForcesTimesTheTime) {
  // Parcels in free flight over the whole box, forces that differ from parcel to parcel and from block to block.
  const Campaign campaign = one_species(0.04, 800);
  constexpr double step = 2e-5;
  auto engine = box_engine(campaign, step);
  std::vector<Parcel> parcels;
  for (double z = 0.1; z < 0.95; z += 0.1)
    for (double x = -0.45; x < 0.5; x += 0.1)
      parcels.push_back(
          new_parcel(campaign, static_cast<std::int64_t>(parcels.size()) + 1, 0, {x, 0.1 * std::sin(9 * x), z}, {}));
  engine->add(parcels);
  const double weight = 9.81 * parcels[0].mass;
  Vector3 expected{};
  double size = 0;
  for (int block = 0; block < 100; ++block) {
    const auto force_on = [&](std::int64_t id) {
      const auto phase = static_cast<double>(id + 17 * block);
      return Vector3{0.3 * weight * std::sin(phase), 0.3 * weight * std::cos(2 * phase), weight * std::cos(3 * phase)};
    };
    std::vector<ParcelForce> forces;
    for (const auto& parcel : engine->owned()) forces.push_back({force_on(parcel.id), 0});
    engine->set_forces(forces);
    for (const auto& parcel : parcels) {
      const auto force = force_on(parcel.id);
      for (std::size_t k = 0; k < 3; ++k) {
        expected[k] += force[k] * 10 * step;
        size += std::abs(force[k]) * 10 * step;
      }
    }
    expected[2] -= weight * static_cast<double>(parcels.size()) * 10 * step;
    engine->advance(10);
  }
  Vector3 found{};
  for (const auto& parcel : everyone(*engine))
    for (std::size_t k = 0; k < 3; ++k) found[k] += parcel.mass * parcel.velocity[k];
  for (std::size_t k = 0; k < 3; ++k) EXPECT_NEAR((found[k] - expected[k]) / size, 0, 1e-10) << k;
}

}  // namespace
}  // namespace cupola::test
