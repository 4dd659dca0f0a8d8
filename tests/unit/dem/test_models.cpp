// Void-fraction models, raceways that keep a void, and the limits that stop a run.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <mpi.h>

#include <algorithm>
#include <cmath>
#include <numeric>

#include "physics/plan/charge.hpp"
#include "physics/plan/dem_time_step.hpp"
#include "schemas/failure.hpp"
#include "stage_dem/batch_charging.hpp"
#include "stage_dem/bed_watch.hpp"
#include "stage_dem/dem_limits.hpp"
#include "stage_dem/parcels.hpp"
#include "stage_dem/raceway_removal.hpp"
#include "stage_dem/solids_on_mesh.hpp"
#include "tests/support/box_mesh.hpp"
#include "tests/unit/dem/box_scene.hpp"

namespace cupola::test {
namespace {

/// The parcels that are this rank's share of a list that every rank has.
std::vector<Parcel> my_share(const std::vector<Parcel>& parcels) {
  int rank = 0;
  int ranks = 1;
  MPI_Comm_rank(MPI_COMM_WORLD, &rank);
  MPI_Comm_size(MPI_COMM_WORLD, &ranks);
  std::vector<Parcel> mine;
  for (const auto& parcel : parcels)
    if (parcel.id % ranks == rank) mine.push_back(parcel);
  return mine;
}

TEST(VoidFraction, BothModelsConserveVolumeForParcelsOfAFifthToFiveCells) {
  Campaign campaign = box_campaign(0.5, 0.6, 1.5);
  campaign.scene.geometry.sides = Geometry::Sides::periodic;
  std::vector<Parcel> parcels = loose_parcels(campaign, 8);
  parcels.push_back(new_parcel(campaign, 9000, 0, {0.499, 0.2999, 0.02}));  // over a corner and the periodic sides
  double expected = 0;
  for (const auto& parcel : parcels) expected += material_volume(campaign, parcel);
  for (const auto model : {DemSettings::VoidFraction::divided, DemSettings::VoidFraction::smoothed}) {
    campaign.dem.void_fraction = model;
    campaign.dem.smoothing_length = 0.3;
    for (const std::int64_t n : {std::int64_t{2}, std::int64_t{10}, std::int64_t{50}}) {  // d/cell 0.2, 1, 5
      cupola::testing::BoxMesh box;
      box.cells = {n, std::max<std::int64_t>(1, n * 3 / 5), n * 3 / 2};
      box.lower = {-0.5, -0.3, 0};
      box.upper = {0.5, 0.3, 1.5};
      box.periodic_y = true;
      const BedMesh mesh = box.make();
      SolidsOnMesh solids(mesh, campaign, MPI_COMM_WORLD);
      const auto mine = my_share(parcels);
      solids.divide(mine);
      const double total = std::accumulate(solids.volume().begin(), solids.volume().end(), 0.0);
      EXPECT_NEAR(total / expected, 1, 1e-12) << n;
      EXPECT_GE(*std::min_element(solids.volume().begin(), solids.volume().end()), 0);
      // What the parcels gather of cell values is what the cells hold of the parcels: sum_i V_i g_i = sum_c V_c g_c.
      std::vector<double> values(mesh.cells());
      double on_cells = 0;
      for (std::size_t cell = 0; cell < mesh.cells(); ++cell) {
        values[cell] = 2 + std::sin(static_cast<double>(cell));
        on_cells += values[cell] * solids.volume()[cell];
      }
      solids.gather(values);
      double on_parcels = 0;
      for (std::size_t i = 0; i < mine.size(); ++i)
        for (const auto& [cell, share] : solids.shares(i))
          on_parcels += material_volume(campaign, mine[i]) * share * values[static_cast<std::size_t>(cell)];
      MPI_Allreduce(MPI_IN_PLACE, &on_parcels, 1, MPI_DOUBLE, MPI_SUM, MPI_COMM_WORLD);
      EXPECT_NEAR(on_parcels / on_cells, 1, 1e-12) << n;
    }
  }
}

TEST(VoidFraction, SmoothingSpreadsAParcelLargerThanItsCells) {
  Campaign campaign = box_campaign(0.5, 1.0, 1.0);
  cupola::testing::BoxMesh box;
  box.cells = {40, 40, 40};
  box.lower = {-0.5, -0.5, 0};
  box.upper = {0.5, 0.5, 1};
  const BedMesh mesh = box.make();
  const std::vector<Parcel> parcel{new_parcel(campaign, 1, 0, {0.012, 0.012, 0.512})};
  const auto spread = [&](DemSettings::VoidFraction model) {
    campaign.dem.void_fraction = model;
    campaign.dem.smoothing_length = 0.2;
    SolidsOnMesh solids(mesh, campaign, MPI_COMM_SELF);
    solids.divide(parcel);
    double second = 0, largest = 0;
    for (std::size_t cell = 0; cell < mesh.cells(); ++cell) {
      second += solids.volume()[cell] * std::pow(mesh.cell_centre[cell][0] - parcel[0].position[0], 2);
      largest = std::max(largest, solids.volume()[cell] / mesh.cell_volume[cell]);
    }
    return std::pair{second / material_volume(campaign, parcel[0]), largest};
  };
  const auto [divided, packed] = spread(DemSettings::VoidFraction::divided);
  const auto [smoothed, loose] = spread(DemSettings::VoidFraction::smoothed);
  EXPECT_NEAR(smoothed - divided, 0.2 * 0.2 / 20, 0.02 * 0.2 * 0.2 / 20);  // the variance of a sphere of 0.2 m
  EXPECT_LT(loose, 0.4 * packed);
}

TEST(Raceways, KeepTheirVoidAndTakeNoMore) {
  Campaign campaign = box_campaign(0.5, 0.6, 1.5);
  campaign.raceways.resize(1);
  auto& raceway = campaign.raceways[0];
  raceway.box = {Vector3{-0.5, -0.3, 0}, Vector3{0.5, 0.3, 0.5}};
  raceway.removal = Raceway::Removal::keep_void;
  raceway.void_fraction = 0.8;
  raceway.dem_removal_rate = 40;
  std::vector<Parcel> parcels = loose_parcels(campaign, 6);
  const auto solids = [&] {
    double volume = 0;
    for (const auto& parcel : parcels)
      if (parcel.position[2] <= 0.5) volume += material_volume(campaign, parcel);
    return volume / 0.3;
  };
  ASSERT_GT(solids(), 0.25);
  MassBooks books(campaign);
  books.put_in(parcels, false);
  RacewayRemoval removal(campaign);
  double before = 0;
  for (long block = 0; block < 200; ++block) {
    double taken = 0;
    for (const auto id : removal.remove(parcels, 0.05, 1, block, books)) {
      const auto found = std::find_if(parcels.begin(), parcels.end(), [&](const Parcel& p) { return p.id == id; });
      taken += found->mass;
      parcels.erase(found);
    }
    EXPECT_LE(taken, 40 * 0.05 + 40 * 1.0);
    before += taken;
  }
  EXPECT_GT(before, 0);
  EXPECT_NEAR(solids(), 0.2, 0.003);  // to within the last whole parcel (0.0018)
  EXPECT_GE(solids(), 0.2);
  EXPECT_EQ(removal.starved_seconds(), 0);
  EXPECT_NEAR(books.residual(parcels), 0, 1e-14);
}

TEST(Charging, ALayerWithARingIsPouredThereOnly) {
  Campaign campaign = box_campaign(1, 0.6, 1.5);
  campaign.charging.stock_line = 1.0;
  campaign.charging.hopper_height = 1.5;
  campaign.charging.layers = {{{"ore", 12.0}}, {{"coke", 6.0}}};
  campaign.charging.rings = {std::array<double, 2>{0.7, 1.0}, std::nullopt};
  BatchCharging charging(campaign);
  std::vector<Parcel> bed;
  std::int64_t next_id = 1;
  double time = 0;
  const auto batch = [&](int species) {
    std::vector<Parcel> poured;
    for (int turn = 0; turn < 100; ++turn, time += 1)
      for (const auto& parcel : charging.pour(bed, 0.9, time, 1, next_id))
        if (parcel.species == species) poured.push_back(parcel);
    return poured;
  };
  double nearest = 1, farthest = 0, coke_nearest = 1;
  for (const auto& parcel : batch(1)) {
    nearest = std::min(nearest, std::abs(parcel.position[0]));
    farthest = std::max(farthest, std::abs(parcel.position[0]));
  }
  EXPECT_GE(nearest, 0.7);
  EXPECT_GT(farthest, 0.9);
  for (const auto& parcel : batch(0)) coke_nearest = std::min(coke_nearest, std::abs(parcel.position[0]));
  EXPECT_LT(coke_nearest, 0.2);
}

TEST(WallOverlap, IsThatOfTheNearestWallOfASlot) {
  Campaign campaign = box_campaign(1, 0.6, 2);
  campaign.scene.geometry.kind = Geometry::Kind::slot;
  campaign.scene.geometry.profile = {{0, 1}, {1, 1}, {2, 0.5}};
  const auto overlap = [&](const Vector3& position) {
    return largest_wall_overlap(campaign, {new_parcel(campaign, 1, 0, position)});  // radius 0.05 m
  };
  EXPECT_EQ(overlap({0, 0, 0.5}), 0);  // touches no wall
  EXPECT_NEAR(overlap({0.97, 0, 0.5}), 1 - 0.03 / 0.05, 1e-9);
  EXPECT_NEAR(overlap({-0.97, 0, 0.5}), 1 - 0.03 / 0.05, 1e-9);
  EXPECT_NEAR(overlap({0, 0, 0.04}), 0.2, 1e-9);
  EXPECT_NEAR(overlap({0, 0.27, 0.5}), 0.4, 1e-9);
  // 0.03 m inside the slanted wall, from its middle.
  const double slant = std::hypot(1, 0.5);
  EXPECT_NEAR(overlap({0.75 - 0.03 / slant, 0, 1.5 - 0.03 * 0.5 / slant}), 0.4, 1e-9);
  EXPECT_NEAR(overlap({0.75 + 0.01 / slant, 0, 1.5 + 0.01 * 0.5 / slant}), 1.2, 1e-9);  // centre beyond the wall
  EXPECT_NEAR(overlap({0.48, 0, 2.2}), 0.6, 1e-9);                                      // in the charging hopper
}

TEST(Limits, AcceptThePapersOwnContactsAndStopWithAdviceBeyond) {
  const Campaign campaign = box_campaign();
  EXPECT_NO_THROW(check_overlaps(campaign, 0.15, 0.42, 1));
  try {
    check_overlaps(campaign, 0.31, 0.1, 77);
    FAIL() << "an overlap of 0.31 R was accepted";
  } catch (const Failure& failure) {
    EXPECT_EQ(failure.code(), ExitCode::diverged);
    EXPECT_THAT(failure.what(), ::testing::HasSubstr("0.31"));
    EXPECT_EQ(failure.where().at("step"), "77");
    EXPECT_EQ(failure.advice().at("contacts.youngs_modulus"), "1e+08 Pa");
    EXPECT_TRUE(failure.advice().contains("dem.rayleigh_fraction"));
  }
  EXPECT_THROW(check_overlaps(campaign, 0.1, 0.61, 1), Failure);
}

TEST(Limits, CreepIsMeasuredAgainstTheDescentOfTheDemStage) {
  Campaign campaign = box_campaign(0.5, 0.6, 1.5);
  campaign.charging.stock_line = 1.0;
  campaign.charging.layers = {{{"coke", 30.0}}};
  campaign.descent_rate = 0.002;
  EXPECT_EQ(creep_over_descent(campaign, 0.01), 0);  // nothing is removed: nothing descends
  campaign.raceways.resize(1);
  campaign.raceways[0].dem_removal_rate = 50 * 0.002 * 0.6 * expected_packing * 800;  // 50 times the charge
  EXPECT_NEAR(creep_over_descent(campaign, 0.01), 0.01 / 0.1, 1e-12);
  EXPECT_NO_THROW(check_creep(campaign, 0.01, 1));
  try {
    check_creep(campaign, 0.03, 5);
    FAIL() << "a creep of 0.3 of the descent was accepted";
  } catch (const Failure& failure) {
    EXPECT_EQ(failure.code(), ExitCode::diverged);
    EXPECT_TRUE(failure.advice().contains("dem.rayleigh_fraction"));
  }
}

TEST(TimeStep, AboveTheStableOneIsRefusedWithTheNumber) {
  Campaign campaign = box_campaign();
  const double reference = dem_time_step(campaign).reference;
  campaign.dem.time_step = 0.29 * reference;
  EXPECT_NO_THROW(dem_time_step(campaign));
  campaign.dem.time_step = 0.4 * reference;
  try {
    dem_time_step(campaign);
    FAIL() << "a step of 40 % of the Rayleigh time was accepted";
  } catch (const Failure& failure) {
    EXPECT_EQ(failure.code(), ExitCode::wrong_input);
    EXPECT_EQ(failure.where().at("key"), "dem.time_step");
    EXPECT_THAT(failure.what(), ::testing::HasSubstr("stable step"));
  }
}

TEST(TimeStep, IsThatOfTheShortestCollisionOfAnyPair) {
  Campaign campaign = box_campaign();
  campaign.contacts.model = Contacts::Model::linear_spring;
  campaign.contacts.stiffness = 1e4;
  for (auto& [name, pair] : campaign.contacts.pairs) pair.restitution = 1;
  const auto time = [](double m1, double n1, double m2, double n2) {
    return M_PI * std::sqrt(m1 * m2 / (m1 + m2) / (2 * n1 * n2 / (n1 + n2) * 1e4));
  };
  const double coke = parcel_mass(campaign.species[0]), ore = parcel_mass(campaign.species[1]);
  EXPECT_NEAR(dem_time_step(campaign).reference,
              std::min({time(coke, 2, coke, 2), time(coke, 2, ore, 4), time(ore, 4, ore, 4)}), 1e-12);
  EXPECT_EQ(dem_time_step(campaign).species, "ore");
}

}  // namespace
}  // namespace cupola::test
