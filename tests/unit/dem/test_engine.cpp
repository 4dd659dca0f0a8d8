#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <mpi.h>

#include <cmath>
#include <map>

#include "schemas/failure.hpp"
#include "stage_dem/liggghts_engine.hpp"
#include "stage_dem/liggghts_instance.hpp"
#include "stage_dem/liggghts_script.hpp"
#include "tests/unit/dem/box_scene.hpp"

namespace cupola::test {
namespace {

/// Two equal parcels fly at each other, far from the walls; relative speed after over before.
double measured_restitution(const Campaign& campaign, double time_step) {
  auto engine = box_engine(campaign, time_step);
  engine->add({make_parcel(campaign, 1, 0, {-0.06, 0, 0.7}, {1, 0, 0}),
               make_parcel(campaign, 2, 0, {0.06, 0, 0.7}, {-1, 0, 0})});
  engine->advance(static_cast<long>(0.03 / time_step));
  const auto after = everyone(*engine);
  return (after[1].velocity[0] - after[0].velocity[0]) / 2;
}

TEST(Engine, HertzCollisionHasTheRestitutionPutIn) {
  for (const double restitution : {0.3, 0.5, 0.9}) {
    Campaign campaign = box_campaign();
    campaign.contacts.pairs["coke-coke"].restitution = restitution;
    EXPECT_NEAR(measured_restitution(campaign, 1e-5), restitution, 0.02);
  }
}

TEST(Engine, LinearSpringCollisionHasTheRestitutionPutIn) {
  for (const double restitution : {0.3, 0.5, 0.9}) {
    Campaign campaign = box_campaign();
    campaign.contacts.model = Contacts::Model::linear_spring;
    campaign.contacts.stiffness = 1e5;
    campaign.contacts.pairs["coke-coke"].restitution = restitution;
    EXPECT_NEAR(measured_restitution(campaign, 1e-5), restitution, 0.005);
  }
}

TEST(Engine, RelativeOverlapOfALinearSpringDoesNotDependOnCoarseGraining) {
  // A parcel at rest on the floor: m g = n K overlap, so overlap/radius ~ n^3/(n n) is the same only per unit of load
  // n^2; in an impact at one speed overlap/radius = v sqrt(m/(n K))/(n r) does not depend on n at all (MODEL 7).
  std::vector<double> relative;
  for (const double n : {1.0, 2.0, 4.0, 8.0}) {
    const double mass = std::pow(n, 3);
    Campaign campaign = box_campaign();
    campaign.species[0].coarse_graining = n;
    campaign.contacts.stiffness = 1e5;
    relative.push_back(std::sqrt(mass / 2 / pair_stiffness(campaign, 0, 0)) / n);
  }
  for (const double value : relative) EXPECT_NEAR(value, relative.front(), 1e-12 * relative.front());
}

TEST(Engine, ErrorsOfLiggghtsBecomeExceptions) {
  LiggghtsInstance liggghts(MPI_COMM_WORLD, "");
  try {
    liggghts.command("no_such_command at all");
    FAIL() << "LIGGGHTS accepted nonsense";
  } catch (const Failure& failure) {
    EXPECT_EQ(failure.code(), ExitCode::diverged);
    EXPECT_THAT(failure.what(), testing::HasSubstr("LIGGGHTS: "));
    EXPECT_EQ(failure.where().at("command"), "no_such_command at all");
  }
}

TEST(Engine, ALostParcelIsNamed) {
  const Campaign campaign = box_campaign();
  auto engine = box_engine(campaign, 1e-4);
  engine->add(
      {make_parcel(campaign, 7, 0, {0, 0, 1.0}, {0, 0, 2}), make_parcel(campaign, 9, 0, {0.3, 0, 1.3}, {0, 0, 400})});
  try {
    engine->advance(100);
    FAIL() << "the parcel was not missed";
  } catch (const Failure& failure) {
    EXPECT_EQ(failure.code(), ExitCode::diverged);
    EXPECT_EQ(failure.where().at("parcel"), "9");
  }
}

TEST(Engine, ForcesAndDampingAct) {
  const Campaign campaign = box_campaign();
  auto engine = box_engine(campaign, 1e-4);
  const Parcel parcel = make_parcel(campaign, 1, 0, {0, 0, 0.5});
  engine->add({parcel});
  engine->advance(1);
  const double weight = parcel.mass * 9.81;
  // Weight and half of it again from below, damped: terminal velocity 0.5 weight/damping, reached with mass/damping =
  // 0.05 s.
  const double damping = parcel.mass / 0.05;
  const auto forces = std::vector<ParcelForce>(engine->owned().size(), ParcelForce{{0, 0, 1.5 * weight}, damping});
  engine->set_forces(forces);
  const double before = everyone(*engine)[0].velocity[2];
  engine->advance(1000);
  const double terminal = 0.5 * weight / damping;
  const double expected = terminal + (before - terminal) * std::exp(-0.1 / 0.05);
  EXPECT_NEAR(everyone(*engine)[0].velocity[2], expected, 1e-3 * terminal);
}

TEST(Engine, DisplacementIsTheWayOverTheLastBlockAcrossPeriodicSides) {
  Campaign campaign = box_campaign();
  campaign.scene.geometry.sides = Geometry::Sides::periodic;
  auto engine = box_engine(campaign, 1e-4);
  engine->add({make_parcel(campaign, 1, 0, {0, 0.299, 1.0}, {0.2, 1.0, 0})});
  engine->advance(100);
  const Parcel parcel = everyone(*engine)[0];
  EXPECT_LT(parcel.position[1], 0);
  EXPECT_NEAR(parcel.displacement[0], 0.002, 1e-9);
  EXPECT_NEAR(parcel.displacement[1], 0.01, 1e-9);
}

/// A settling heap of both species.
std::unique_ptr<Engine> settling_heap(const Campaign& campaign, long blocks) {
  auto engine = box_engine(campaign, 1e-4);
  engine->add(loose_parcels(campaign, 4));
  for (long block = 0; block < blocks; ++block) engine->advance(200);
  return engine;
}

double largest_difference(const std::vector<Parcel>& a, const std::vector<Parcel>& b) {
  double largest = 0;
  for (std::size_t i = 0; i < a.size(); ++i)
    for (std::size_t k = 0; k < 3; ++k) {
      largest = std::max(largest, std::abs(a[i].position[k] - b[i].position[k]));
      largest = std::max(largest, std::abs(a[i].velocity[k] - b[i].velocity[k]));
      largest = std::max(largest, std::abs(a[i].angular_velocity[k] - b[i].angular_velocity[k]));
    }
  return largest;
}

TEST(Engine, ASnapshotGoesOnExactlyAsTheUndisturbedRun) {
  const Campaign campaign = box_campaign();
  auto undisturbed = settling_heap(campaign, 10);
  std::vector<std::uint8_t> bytes;
  {
    auto stopped = settling_heap(campaign, 5);
    bytes = stopped->snapshot();
  }
  auto resumed = box_engine(campaign, 1e-4, bytes);
  for (int block = 0; block < 5; ++block) resumed->advance(200);
  const auto expected = everyone(*undisturbed);
  const auto found = everyone(*resumed);
  ASSERT_EQ(found.size(), expected.size());
  EXPECT_EQ(resumed->step(), undisturbed->step());
  EXPECT_EQ(largest_difference(found, expected), 0.0);
}

/// The parcels of this rank are the same, in the same order, to the last bit.
void expect_same_bits(const Engine& a, const Engine& b) {
  static_assert(std::is_trivially_copyable_v<Parcel>);
  const auto ours = a.owned();
  const auto theirs = b.owned();
  ASSERT_EQ(ours.size(), theirs.size());
  for (std::size_t i = 0; i < ours.size(); ++i) {
    EXPECT_EQ(ours[i].id, theirs[i].id) << "place " << i;
    EXPECT_EQ(ours[i].position, theirs[i].position) << "place " << i;
    EXPECT_EQ(ours[i].velocity, theirs[i].velocity) << "place " << i;
    EXPECT_EQ(ours[i].displacement, theirs[i].displacement) << "place " << i;
  }
}

TEST(Engine, TakingASnapshotChangesNothing) {
  // Parcels fly through the periodic sides and from rank to rank in every block.
  Campaign campaign = box_campaign();
  campaign.scene.geometry.sides = Geometry::Sides::periodic;
  auto undisturbed = box_engine(campaign, 1e-4);
  auto disturbed = box_engine(campaign, 1e-4);
  for (auto* engine : {undisturbed.get(), disturbed.get()}) {
    auto parcels = loose_parcels(campaign, 3);
    for (auto& parcel : parcels) parcel.velocity = {parcel.id % 2 == 0 ? 2.0 : -2.0, 1.5, 0};
    engine->add(parcels);
  }
  for (int block = 0; block < 8; ++block) {
    for (auto* engine : {undisturbed.get(), disturbed.get()}) {
      engine->advance(200);
      engine->exchange();
    }
    static_cast<void>(disturbed->snapshot());
    expect_same_bits(*disturbed, *undisturbed);
  }
}

TEST(Engine, ASnapshotHoldsTheParcelsInTheirOrder) {
  const Campaign campaign = box_campaign();
  auto undisturbed = settling_heap(campaign, 5);
  undisturbed->exchange();
  const auto bytes = undisturbed->snapshot();
  auto resumed = box_engine(campaign, 1e-4, bytes);
  for (int block = 0; block < 3; ++block) {
    expect_same_bits(*resumed, *undisturbed);
    for (auto* engine : {undisturbed.get(), resumed.get()}) {
      engine->advance(200);
      engine->exchange();
    }
  }
}

TEST(Engine, RemovingAParcelLeavesTheContactHistoryOfTheOthers) {
  // A settled heap, and a lone parcel held up by nothing that never touches it.  Taking the lone one away moves another
  // parcel into its place in the arrays; the heap must not notice beyond round-off from the order of sums.
  const Campaign campaign = box_campaign();
  const auto run = [&](bool remove) {
    auto engine = box_engine(campaign, 1e-4);
    std::vector<Parcel> parcels{make_parcel(campaign, 1000, 0, {0.3, 0, 1.3}, {0, 0, 2.0})};
    const auto heap = loose_parcels(campaign, 3);
    parcels.insert(parcels.end(), heap.begin(), heap.end());
    engine->add(parcels);
    for (int block = 0; block < 10; ++block) engine->advance(200);
    if (remove) engine->remove({1000});
    engine->advance(200);
    engine->advance(200);
    auto found = everyone(*engine);
    std::erase_if(found, [](const Parcel& parcel) { return parcel.id == 1000; });
    return found;
  };
  const auto with = run(false);
  const auto without = run(true);
  ASSERT_EQ(with.size(), without.size());
  EXPECT_LT(largest_difference(with, without), 1e-9);
}

TEST(Engine, AddingAParcelKeepsTagsAndTheOthers) {
  const Campaign campaign = box_campaign();
  auto engine = settling_heap(campaign, 3);
  const auto before = engine->count();
  engine->add({make_parcel(campaign, 5000, 1, {0.2, 0.1, 1.2})});
  EXPECT_EQ(engine->count(), before + 1);
  engine->advance(100);
  std::map<std::int64_t, Parcel> found;
  for (const auto& parcel : everyone(*engine)) found[parcel.id] = parcel;
  EXPECT_EQ(static_cast<std::int64_t>(found.size()), before + 1);
  ASSERT_TRUE(found.contains(5000));
  EXPECT_EQ(found[5000].species, 1);
  EXPECT_NEAR(found[5000].displacement[2], -0.5 * 9.81 * 1e-4, 1e-7);
}

TEST(Engine, HeldParcelsStandStillAndTheOthersGoOn) {
  const Campaign campaign = box_campaign();
  auto engine = settling_heap(campaign, 3);  // still falling
  const auto is_held = [](const Parcel& parcel) { return parcel.id % 3 == 0; };
  const auto push = [&](Engine& of) {
    std::vector<bool> held;
    std::vector<ParcelForce> forces;
    for (const auto& parcel : of.owned()) {
      held.push_back(is_held(parcel));
      forces.push_back({{0.1 * parcel.mass, 0, 2 * 9.81 * parcel.mass}, 0});
    }
    of.hold(held);
    of.set_forces(forces);
  };
  const auto before = everyone(*engine);
  push(*engine);
  std::vector<std::uint8_t> bytes;
  for (int block = 0; block < 4; ++block) {
    engine->advance(100);
    engine->exchange();
    if (block == 1) bytes = engine->snapshot();
  }
  const auto after = everyone(*engine);
  for (std::size_t i = 0; i < after.size(); ++i) {
    if (is_held(after[i])) {
      EXPECT_EQ(after[i].position, before[i].position) << after[i].id;
      EXPECT_EQ(after[i].velocity, (Vector3{})) << after[i].id;
      EXPECT_EQ(after[i].angular_velocity, (Vector3{})) << after[i].id;
    } else {
      EXPECT_NE(after[i].position, before[i].position) << after[i].id;
    }
  }
  auto resumed = box_engine(campaign, 1e-4, bytes);
  for (int block = 0; block < 2; ++block) {
    resumed->advance(100);
    resumed->exchange();
  }
  EXPECT_EQ(largest_difference(everyone(*resumed), after), 0.0);
  engine->hold(std::vector<bool>(engine->owned().size(), false));
  engine->advance(100);
  for (const auto& parcel : everyone(*engine)) EXPECT_GT(std::abs(parcel.velocity[0]), 0) << parcel.id;
}

TEST(Engine, ResizingKeepsTheMass) {
  const Campaign campaign = box_campaign();
  auto engine = settling_heap(campaign, 2);
  std::vector<double> radii;
  for (const auto& parcel : engine->owned()) radii.push_back(0.95 * parcel.radius);
  const auto before = everyone(*engine);
  engine->resize(radii);
  engine->advance(50);
  const auto after = everyone(*engine);
  for (std::size_t i = 0; i < after.size(); ++i) {
    EXPECT_EQ(after[i].mass, before[i].mass);
    EXPECT_DOUBLE_EQ(after[i].radius, 0.95 * before[i].radius);
  }
}

}  // namespace
}  // namespace cupola::test
