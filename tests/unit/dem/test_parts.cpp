#include <gtest/gtest.h>
#include <mpi.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <numeric>

#include "schemas/failure.hpp"
#include "stage_dem/batch_charging.hpp"
#include "stage_dem/bed_builder.hpp"
#include "stage_dem/bed_surface.hpp"
#include "stage_dem/bed_watch.hpp"
#include "stage_dem/mass_books.hpp"
#include "stage_dem/packing_check.hpp"
#include "stage_dem/parcels.hpp"
#include "stage_dem/pouring.hpp"
#include "stage_dem/raceway_removal.hpp"
#include "stage_dem/softening.hpp"
#include "stage_dem/solids_on_mesh.hpp"
#include "stage_dem/window_averages.hpp"
#include "tests/support/box_mesh.hpp"
#include "tests/unit/dem/box_scene.hpp"

namespace cupola::test {
namespace {

Campaign furnace() {
  Campaign campaign = box_campaign(0.5, 0.6, 1.5);
  campaign.scene.geometry.sides = Geometry::Sides::periodic;
  campaign.species[1].softening = Softening{1475, 1675};
  campaign.species[1].none_below = 0.3;
  campaign.initial.cohesive_zone = InvertedV{0.6, 0.2, 2000, 300};
  campaign.charging.stock_line = 1.0;
  campaign.charging.layers = {{{"coke", 30.0}}, {{"ore", 90.0}}};
  campaign.raceways.resize(1);
  campaign.raceways[0].box = {Vector3{-0.5, -0.3, 0}, Vector3{0, 0.3, 0.4}};
  campaign.raceways[0].dem_removal_rate = 5;
  return campaign;
}

TEST(Random, SameNumbersForTheSameKeyAndOthersForAnother) {
  RandomNumbers a(7, RandomNumbers::Use::raceway, 3), b(7, RandomNumbers::Use::raceway, 3),
      c(7, RandomNumbers::Use::charging, 3);
  double mean = 0;
  bool differs = false;
  for (int i = 0; i < 1000; ++i) {
    const double value = a.next();
    ASSERT_GE(value, 0);
    ASSERT_LT(value, 1);
    EXPECT_EQ(value, b.next());
    differs = differs || value != c.next();
    mean += value / 1000;
  }
  EXPECT_TRUE(differs);
  EXPECT_NEAR(mean, 0.5, 0.05);
}

TEST(PackingCheck, RefusesWhatIsNoPackingOfThisFurnaceAndNamesTheParcel) {
  const Campaign campaign = furnace();
  std::vector<Parcel> whole;
  for (const auto& [x, z] : {std::pair{-0.3, 0.5}, {0.0, 0.5}, {0.3, 1.7}})  // the last one still in the hopper
    whole.push_back(new_parcel(campaign, static_cast<std::int64_t>(whole.size()) + 1, 0, {x, 0, z}));
  EXPECT_NO_THROW(check_packing(campaign, whole, "packing"));
  const auto said = [&](const std::function<void(std::vector<Parcel>&)>& spoil) {
    auto parcels = whole;
    spoil(parcels);
    try {
      check_packing(campaign, parcels, "packing");
    } catch (const Failure& failure) {
      EXPECT_EQ(failure.code(), ExitCode::wrong_input);
      return std::string(failure.what());
    }
    return std::string("accepted");
  };
  using Parcels = std::vector<Parcel>;
  const double radius = whole[0].radius;
  const std::vector<std::pair<std::string, std::function<void(Parcels&)>>> spoilt{
      {"parcel 1 overlaps parcel 2 by 0.50 of the radius", [&](Parcels& p) { p[1].position[0] = -0.3 + 1.5 * radius; }},
      {"accepted", [&](Parcels& p) { p[1].position[0] = -0.3 + 1.75 * radius; }},
      {"parcel 3 lies outside the furnace, at 0.7 0 0.5 m",
       [](Parcels& p) {
         p[2].position = {0.7, 0, 0.5};
       }},
      {"parcel 1 lies outside the furnace", [](Parcels& p) { p[0].position[2] = -0.01; }},
      {"parcel 2 lies outside the furnace", [](Parcels& p) { p[1].position[2] = 9; }},
      {"parcel 2 overlaps a wall by 0.70", [&](Parcels& p) { p[1].position[0] = 0.5 - 0.3 * radius; }},
      {"accepted", [](Parcels& p) { p[1].position[1] = 0.31; }},  // beyond the period: the same place as -0.29
      {"parcel 2 has a place or velocity that is no number", [](Parcels& p) { p[1].velocity[1] = NAN; }},
      {"parcel 1 has a radius of 0 m", [](Parcels& p) { p[0].radius = 0; }},
      {"parcel 1 has a radius of", [](Parcels& p) { p[0].mass = -1; }},
      {"parcel 3 is of species 7, but the campaign has 2", [](Parcels& p) { p[2].species = 7; }},
      {"parcel 1 is there twice", [](Parcels& p) { p[1].id = 1; }}};
  for (const auto& [sentence, spoil] : spoilt) EXPECT_NE(said(spoil).find(sentence), std::string::npos) << said(spoil);
}

TEST(Softening, RadiusFollowsTheTemperatureAndNeverGrowsWithinAStage) {
  const Campaign campaign = furnace();
  Parcel ore = new_parcel(campaign, 1, 1, {0, 0, 1});
  const double whole = ore.radius;
  EXPECT_DOUBLE_EQ(soften(campaign, ore, 1000), whole);
  ore.radius = soften(campaign, ore, 1675);
  EXPECT_NEAR(ore.radius, whole * std::cbrt(0.64), 1e-15);
  EXPECT_NEAR(present_factor(campaign, ore), 1 / 0.64, 1e-12);
  EXPECT_DOUBLE_EQ(soften(campaign, ore, 1000), ore.radius);
  EXPECT_NEAR(regrow(campaign, ore, 1000), 1.002 * ore.radius, 1e-15);
  int runs = 0;
  for (double before = 0; before != ore.radius && runs < 1000; ++runs) {
    before = ore.radius;
    ore.radius = regrow(campaign, ore, 1000);
  }
  EXPECT_NEAR(ore.radius, whole, 1e-15);
  EXPECT_LT(runs, 100);
  EXPECT_TRUE(melted(campaign, ore, 1675));
  EXPECT_FALSE(melted(campaign, new_parcel(campaign, 2, 0, {}), 3000));
}

TEST(SolidsOnMesh, TheVolumeOfEveryParcelInTheMeshIsThereExactly) {
  // Cells from a fifth of a parcel's diameter to five of them, parcels across periodic sides and cell faces, softened
  // ones too.
  const Campaign campaign = furnace();
  for (const std::int64_t n : {std::int64_t{2}, std::int64_t{8}, std::int64_t{40}}) {
    cupola::testing::BoxMesh box;
    box.cells = {n, std::max<std::int64_t>(1, n / 2), n};
    box.lower = {-0.5, -0.3, 0};
    box.upper = {0.5, 0.3, 1.5};
    box.periodic_y = true;
    const BedMesh mesh = box.make();
    SolidsOnMesh solids(mesh, campaign, MPI_COMM_SELF);
    std::vector<Parcel> parcels = loose_parcels(campaign, 6);
    for (std::size_t i = 0; i < parcels.size(); i += 3) parcels[i].radius *= 0.9;
    parcels.push_back(new_parcel(campaign, 9000, 0, {0.1, 0.2999, 0.8}));
    parcels.push_back(new_parcel(campaign, 9001, 0, {0.1, 0.2, 1.7}));  // in the hopper: left out
    solids.divide(parcels);
    double expected = 0;
    double contact = 0;
    for (std::size_t i = 0; i + 1 < parcels.size(); ++i) {
      expected += material_volume(campaign, parcels[i]);
      contact += contact_volume(parcels[i]);
    }
    EXPECT_NEAR(std::accumulate(solids.volume().begin(), solids.volume().end(), 0.0), expected, 1e-13 * expected);
    const auto contacts = solids.sums(1, [&](std::size_t i, std::span<double> value) {
      value[0] = contact_volume(parcels[i]);
      return true;
    });
    EXPECT_NEAR(std::accumulate(contacts.begin(), contacts.end(), 0.0), contact, 1e-13 * contact);
    EXPECT_EQ(solids.cell(parcels.size() - 1), -1);
  }
}

TEST(Books, CloseExactlyAndRacewaysTakeTheirRate) {
  const Campaign campaign = furnace();
  std::vector<Parcel> parcels = loose_parcels(campaign, 6);
  MassBooks books(campaign);
  books.put_in(parcels, false);
  RacewayRemoval raceways(campaign);
  double taken = 0;
  for (long block = 0; block < 100; ++block) {
    const auto gone = raceways.remove(parcels, 0.05, 1, block, books);
    for (const auto id : gone) {
      const auto found = std::find_if(parcels.begin(), parcels.end(), [&](const Parcel& p) { return p.id == id; });
      ASSERT_NE(found, parcels.end());
      EXPECT_LT(found->position[0], 0);
      taken += found->mass;
      parcels.erase(found);
    }
  }
  EXPECT_NEAR(taken, 5 * 0.05 * 100, 0.9);  // to within a parcel
  EXPECT_EQ(raceways.starved_seconds(), 0);
  EXPECT_NEAR(books.residual(parcels), 0, 1e-14);
  EXPECT_NEAR(books.mass(books.raceways()[0]), taken, 1e-12);
  parcels.pop_back();
  EXPECT_GT(std::abs(books.residual(parcels)), 1e-4);
}

TEST(Raceways, StarveAloudAndDoNotGulpAfterwards) {
  const Campaign campaign = furnace();
  MassBooks books(campaign);
  RacewayRemoval raceways(campaign);
  const std::vector<Parcel> empty;
  for (long block = 0; block < 100; ++block) static_cast<void>(raceways.remove(empty, 0.05, 1, block, books));
  EXPECT_NEAR(raceways.starved_seconds(), 4.0, 0.06);  // of 5 s, the first second may be late
  const auto parcels = loose_parcels(campaign, 6);
  double taken = 0;
  for (const auto id : raceways.remove(parcels, 0.05, 1, 101, books))
    taken += parcels[static_cast<std::size_t>(id - 1)].mass;
  EXPECT_LE(taken, 5 * 1.05 + 1e-9);
}

TEST(Charging, BatchesAreExactOverTime) {
  const Campaign campaign = furnace();
  BatchCharging charging(campaign);
  MassBooks books(campaign);
  std::int64_t next_id = 1;
  double time = 0;
  for (int batch = 0; batch < 20; ++batch) {
    std::vector<Parcel> parcels;
    do {
      const auto added = charging.pour(parcels, 0.5, time, 1, next_id);
      books.put_in(added, true);
      parcels.insert(parcels.end(), added.begin(), added.end());
      if (added.empty()) parcels.clear();  // they have fallen away
    } while (charging.state().owed[0] + charging.state().owed[1] > 0);
    charging.see_landed({});
    time += 10;
  }
  const auto& counts = books.charged();
  for (std::size_t s = 0; s < 2; ++s) {
    const double wanted = 10 * (s == 0 ? 30.0 : 90.0);
    const double charged = static_cast<double>(counts[s]) * parcel_mass(campaign.species[s]);
    EXPECT_NEAR(charged + charging.state().carried[s], wanted, 1e-9);
    EXPECT_LT(charging.state().carried[s], parcel_mass(campaign.species[s]));
  }
}

TEST(Charging, ALayerWithARingIsPouredIntoIt) {
  Campaign campaign = furnace();
  campaign.charging.layers = {{{"coke", 30.0}}, {{"ore", 20.0}}};
  campaign.charging.rings = {std::nullopt, std::array<double, 2>{0.2, 0.35}};
  BatchCharging charging(campaign);
  std::int64_t next_id = 1;
  int coke_in_the_middle = 0;
  int ore = 0;
  double time = 0;
  for (int batch = 0; batch < 6; ++batch, time += 10) {
    for (int turn = 0; turn == 0 || charging.state().owed[0] + charging.state().owed[1] > 0; ++turn) {
      ASSERT_LT(turn, 100);
      for (const Parcel& parcel : charging.pour({}, 0.5, time, 1, next_id)) {
        if (parcel.species == 0 && std::abs(parcel.position[0]) < 0.2) ++coke_in_the_middle;
        if (parcel.species != 1) continue;
        ++ore;
        EXPECT_GE(std::abs(parcel.position[0]), 0.2);
        EXPECT_LE(std::abs(parcel.position[0]), 0.35);
      }
    }
    charging.see_landed({});
  }
  EXPECT_GT(ore, 0);
  EXPECT_GT(coke_in_the_middle, 0);  // the other layer covers the whole width
}

TEST(Charging, ABatchTooLargeForTheRoomIsRefused) {
  Campaign campaign = furnace();
  campaign.charging.layers.push_back({{"ore", 5000.0}});
  EXPECT_THROW(BatchCharging{campaign}, Failure);
}

TEST(Pouring, NothingTouchesAnythingAndAllAreInside) {
  const Campaign campaign = furnace();
  Pouring pouring(campaign, {});
  RandomNumbers random(3, RandomNumbers::Use::building, 0);
  std::int64_t id = 1;
  while (pouring.place(
      0.1, 1.2, id, [&](double) { return static_cast<int>(id % 2); }, random, 100))
    ++id;
  const auto& parcels = pouring.placed();
  EXPECT_GT(parcels.size(), 150U);
  EXPECT_EQ(largest_overlap(campaign, parcels, MPI_COMM_SELF), 0);
  for (const auto& parcel : parcels) EXPECT_LE(std::abs(parcel.position[0]) + parcel.radius, 0.5 + 1e-12);
}

TEST(WindowAverages, MeanAndStandardErrorOfKnownBatches) {
  // Uncorrelated batches b = 1, 3, 1, 3, … have a negative successive correlation, so no widening; variance of n = 8
  // batches: sum (b - 2)^2 = 8, error = sqrt(8/(8*7)).
  WindowAverages averages(1, 0.1);
  for (int i = 0; i < 8; ++i) {
    const double b = i % 2 == 0 ? 1 : 3;
    for (int half = 0; half < 2; ++half) averages.add({{0.5}, {0.6}, {0.5 * b, 0, 0}}, 0.05);
  }
  const auto fields = averages.fields();
  EXPECT_EQ(averages.batches(), 8);
  EXPECT_DOUBLE_EQ(fields.velocity[0], 2);
  EXPECT_DOUBLE_EQ(fields.fraction[0], 0.5);
  EXPECT_NEAR(fields.contact_fraction[0], 0.6, 1e-15);
  EXPECT_NEAR(fields.velocity_error[0], std::sqrt(8.0 / 56), 1e-12);
  EXPECT_NEAR(fields.fraction_error[0], 0, 1e-12);
}

TEST(WindowAverages, CorrelatedBatchesWidenTheError) {
  WindowAverages averages(1, 0.1);
  for (int i = 0; i < 16; ++i) {
    const double b = i < 8 ? 1 : 3;
    averages.add({{0.5}, {0.6}, {0.5 * b, 0, 0}}, 0.1);
  }
  // Deviations -1 (8 times) then +1 (8 times): successive products 14 of 15 positive, correlation (13/15)/1 limited to
  // 0.8, w = 9 limited to half the batches.
  const double plain = std::sqrt(16.0 / (16 * 15));
  EXPECT_NEAR(averages.fields().velocity_error[0], plain * std::sqrt(8 * 15.0 / (16 - 8)), 1e-9);
}

TEST(WindowAverages, GrowthIsTheSlopeOfAFractionThatRisesSteadily) {
  WindowAverages averages(1, 0.1);
  for (int i = 0; i < 10; ++i) averages.add({{0.5 + 0.02 * i}, {0.6}, {0, 0, 0}}, 0.1);
  EXPECT_NEAR(averages.fields().fraction_growth[0], 0.2, 1e-12);
}

TEST(BedBuilder, BuildsALayeredBedToTheStockLineWithOreWhereItStaysSolid) {
  const Campaign campaign = furnace();
  const OreTemperature temperature(campaign);
  auto engine = box_engine(campaign, 2e-4);
  BedBuilder builder(campaign);
  std::int64_t next_id = 1;
  double time = 0;
  std::vector<Parcel> parcels;
  while (!builder.done() && time < 30) {
    const auto added = builder.pour(parcels, temperature, time, 5, next_id);
    if (!added.empty()) engine->add(added);
    engine->advance(250);
    time += 0.05;
    parcels = gather_parcels(*engine, MPI_COMM_WORLD);
  }
  ASSERT_TRUE(builder.done());
  EXPECT_EQ(static_cast<std::int64_t>(parcels.size()), next_id - 1);
  EXPECT_NEAR(bed_surface(campaign, parcels), 1.0, 0.12);
  int ore = 0;
  for (const auto& parcel : parcels) {
    if (parcel.species != 1) continue;
    ++ore;
    // Poured above the zone; settling moves a parcel by less than two radii.
    EXPECT_GT(parcel.position[2], 0.6 - 0.2 * std::abs(parcel.position[0]) - 0.16);
  }
  EXPECT_GT(ore, 40);
  // Interior packing of a loosely poured bed.
  double solid = 0;
  for (const auto& parcel : parcels)
    if (parcel.position[2] > 0.2 && parcel.position[2] < 0.8) solid += contact_volume(parcel);
  EXPECT_NEAR(solid / (1.0 * 0.6 * 0.6), 0.54, 0.06);
}

}  // namespace
}  // namespace cupola::test
