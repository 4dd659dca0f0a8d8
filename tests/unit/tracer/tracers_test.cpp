#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <set>

#include "physics/mesh/cell_locator.hpp"
#include "physics/projection/bed_state.hpp"
#include "schemas/failure.hpp"
#include "stage_tracer/cell_contents.hpp"
#include "stage_tracer/displacement.hpp"
#include "stage_tracer/ledger.hpp"
#include "stage_tracer/motion.hpp"
#include "stage_tracer/random.hpp"
#include "stage_tracer/seeding.hpp"
#include "stage_tracer/stays.hpp"
#include "tests/support/box_mesh.hpp"
#include "tests/support/furnaces.hpp"

namespace cupola {
namespace {

class TracersTest : public ::testing::Test {
 protected:
  TracersTest() {
    testing::BoxMesh box;
    box.cells = {6, 4, 10};
    box.lower = {-0.6, -0.4, 0};
    box.upper = {0.6, 0.4, 2};
    box.periodic_y = true;
    mesh_ = box.make();
    campaign_.charging.stock_line = 1.4;
    bed_ = bed_cells(mesh_, campaign_);
  }

  /// Parcels on a grid, some of them above the stock line.
  [[nodiscard]] Packing grid() const {
    Packing packing;
    for (double z = 0.1; z < 2; z += 0.2) {
      for (double x = -0.5; x < 0.6; x += 0.2) {
        packing.id.push_back(static_cast<std::int64_t>(packing.id.size()) + 5);
        packing.species.push_back(packing.id.size() % 2 == 0 ? 1 : 0);
        packing.position.push_back({x, 0.39, z});
        packing.radius.push_back(0.09);
        packing.mass.push_back(2.0 + 0.01 * static_cast<double>(packing.id.size()));
      }
    }
    return packing;
  }

  Campaign campaign_ = furnaces::shaft();
  BedMesh mesh_;
  std::vector<bool> bed_;
};

TEST_F(TracersTest, SeedingKeepsTheVolumeAndIsTheSameOnAnyNumberOfRanks) {
  const CellLocator locator(mesh_);
  const PathField paths(mesh_, std::vector<double>(mesh_.faces(), 0.0), std::vector<double>(mesh_.cells(), 1.0));
  const Packing packing = grid();
  campaign_.tracer.tracers_per_cell = 4;
  const int split = tracers_per_parcel(campaign_, locator, bed_, packing);
  const Tracers all = seed_tracers(campaign_, locator, paths, bed_, packing, split, 1, 0, 1);
  double parcels = 0;
  double volume = 0;
  for (std::size_t p = 0; p < packing.id.size(); ++p) {
    if (packing.position[p][2] >= 1.4) continue;
    parcels += 1;
    volume += packing.mass[p] / campaign_.species[packing.species[p]].density;
  }
  double seeded = 0;
  for (std::size_t i = 0; i < all.size(); ++i) {
    seeded += all.volume[i];
    EXPECT_TRUE(bed_[static_cast<std::size_t>(all.point[i].cell)]);
    EXPECT_GT(all.life[i], 0);
    if (i > 0) {
      EXPECT_GT(all.id[i], all.id[i - 1]);
    }
  }
  EXPECT_EQ(all.size(), static_cast<std::size_t>(parcels) * static_cast<std::size_t>(split));
  EXPECT_NEAR(seeded, volume, 1e-12 * volume);
  EXPECT_GE(static_cast<double>(all.size()), 4.0 * static_cast<double>(std::count(bed_.begin(), bed_.end(), true)));

  std::vector<double> rows;
  for (int rank = 0; rank < 3; ++rank) {
    const auto part = to_rows(seed_tracers(campaign_, locator, paths, bed_, packing, split, 1, rank, 3));
    rows.insert(rows.end(), part.begin(), part.end());
  }
  const Tracers joined = from_rows(rows, false, 0, 1);
  ASSERT_EQ(joined.size(), all.size());
  for (std::size_t i = 0; i < all.size(); ++i) {
    const auto j =
        static_cast<std::size_t>(std::find(joined.id.begin(), joined.id.end(), all.id[i]) - joined.id.begin());
    ASSERT_LT(j, joined.size());
    EXPECT_EQ(joined.life[j], all.life[i]);
    EXPECT_EQ(joined.point[j].reference, all.point[i].reference);
  }
}

TEST_F(TracersTest, SortingByCellKeepsEachTracerTogetherAndTheOrderWithinACell) {
  Tracers tracers;
  for (std::int64_t id = 0; id < 500; ++id) {
    tracers.add(id, static_cast<std::uint8_t>(id % 2), {(id * 37) % 11, {0.001 * static_cast<double>(id), 0.5, 0.5}},
                1e-3 * static_cast<double>(id), 1.0 + static_cast<double>(id));
    tracers.temperature.push_back(300 + static_cast<double>(id));
  }
  tracers.sort_by_cell(mesh_.cells());
  for (std::size_t i = 0; i < tracers.size(); ++i) {
    const auto id = static_cast<double>(tracers.id[i]);
    EXPECT_EQ(tracers.point[i].cell, (tracers.id[i] * 37) % 11);
    EXPECT_EQ(tracers.point[i].reference[0], 0.001 * id);
    EXPECT_EQ(tracers.volume[i], 1e-3 * id);
    EXPECT_EQ(tracers.life[i], 1 + id);
    EXPECT_EQ(tracers.temperature[i], 300 + id);
    if (i > 0 && tracers.point[i].cell == tracers.point[i - 1].cell) {
      EXPECT_GT(tracers.id[i], tracers.id[i - 1]);
    }
    if (i > 0) {
      EXPECT_GE(tracers.point[i].cell, tracers.point[i - 1].cell);
    }
  }
}

TEST_F(TracersTest, TracersAreDealtOutEvenlyHoweverParcelsAreSplit) {
  for (const int split : {1, 2, 5}) {
    for (const int ranks : {2, 3}) {
      std::vector<int> count(static_cast<std::size_t>(ranks), 0);
      for (std::int64_t parcel = 7; parcel < 307; ++parcel) {
        for (int j = 0; j < split; ++j)
          ++count[static_cast<std::size_t>(rank_of(parcel * tracer_ids_per_parcel + j, ranks))];
      }
      EXPECT_LE(*std::max_element(count.begin(), count.end()) - *std::min_element(count.begin(), count.end()), split);
    }
  }
}

TEST_F(TracersTest, SeedingNeedsAParcelInTheBed) {
  const CellLocator locator(mesh_);
  Packing packing = grid();
  for (Vector3& position : packing.position) position[2] = 1.9;
  EXPECT_THROW(tracers_per_parcel(campaign_, locator, bed_, packing), Failure);
}

TEST_F(TracersTest, RacewayRemovesAtItsRateForAnyStep) {
  GranularField field;
  field.bed = bed_;
  field.stagnant.assign(mesh_.cells(), false);
  field.removal_rate.assign(mesh_.cells(), 0.02);
  const PathField paths(mesh_, std::vector<double>(mesh_.faces(), 0.0), std::vector<double>(mesh_.cells(), 1.0));
  const Motion motion(campaign_, field, paths);
  const int count = 20000;
  std::vector<std::vector<std::int64_t>> left;
  for (const double step : {40.0, 1.0}) {
    Tracers tracers;
    for (std::int64_t id = 0; id < count; ++id) tracers.add(id, 0, {7, {0.5, 0.5, 0.5}}, 1e-4, draw_life(3, id));
    Tally tally;
    for (double time = 0; time < 40; time += step) {
      const Leaving leaving = motion.advance(tracers, time, time + step, {}, 3, tally).leaving;
      remove_leaving(tracers, leaving, campaign_, tally);
    }
    const double expected = count * std::exp(-0.8);
    EXPECT_NEAR(static_cast<double>(tracers.size()), expected, 4 * std::sqrt(expected * (1 - std::exp(-0.8))));
    EXPECT_NEAR(tally.of(tally.mass, Cause::raceway), (count - static_cast<double>(tracers.size())) * 1e-4 * 800, 1e-8);
    left.push_back(tracers.id);
  }
  EXPECT_EQ(left[0], left[1]);
}

TEST_F(TracersTest, MeltingSpeciesTooLowIsCountedAsUnmelted) {
  GranularField field;
  field.bed = bed_;
  field.stagnant.assign(mesh_.cells(), false);
  field.removal_rate.assign(mesh_.cells(), 0.0);
  campaign_.species[1].softening = Softening{1475, 1675};
  campaign_.species[1].none_below = 0.3;
  const PathField paths(mesh_, std::vector<double>(mesh_.faces(), 0.0), std::vector<double>(mesh_.cells(), 1.0));
  Tracers tracers;
  for (std::int64_t id = 0; id < 4; ++id)
    tracers.add(id, static_cast<std::uint8_t>(id % 2), {id < 2 ? 0 : 100, {0.5, 0.5, 0.5}}, 1e-3, 1);
  Tally tally;
  remove_leaving(tracers, Motion(campaign_, field, paths).advance(tracers, 0, 1, {}, 3, tally).leaving, campaign_,
                 tally);
  EXPECT_EQ(tracers.id, (std::vector<std::int64_t>{0, 2, 3}));
  EXPECT_DOUBLE_EQ(tally.of(tally.mass, Cause::unmelted), 3);
}

TEST_F(TracersTest, DisplacementSpreadsAnExcessAndNeverLeavesTheBed) {
  const CellLocator locator(mesh_);
  const PathField paths(mesh_, std::vector<double>(mesh_.faces(), 0.0), std::vector<double>(mesh_.cells(), 1.0));
  Tracers tracers;
  const std::int64_t corner = 0;
  for (std::int64_t id = 0; id < 2000; ++id) tracers.add(id, 0, {corner, {0.5, 0.5, 0.5}}, 1e-5, 1);
  TracerSettings settings;
  settings.displacement_coefficient = 5e-4;
  settings.displacement_limit = 0.05;
  const std::vector<double> target(mesh_.cells(), 0.5);
  std::vector<double> excess;
  for (long step = 0; step < 300; ++step) {
    const CellContents contents = sum_tracers(tracers, 1, mesh_.cells(), false, [](std::vector<double>&) {});
    excess = volume_excess(mesh_, bed_, contents.volume[0], target);
    displace(tracers, settings, locator, paths, bed_, excess, 5, 11, step);
  }
  ASSERT_EQ(tracers.size(), 2000U);
  double densest = 0;
  const CellContents after = sum_tracers(tracers, 1, mesh_.cells(), false, [](std::vector<double>&) {});
  for (std::size_t c = 0; c < mesh_.cells(); ++c) {
    densest = std::max(densest, after.volume[0][c] / mesh_.cell_volume[c]);
    if (!bed_[c]) {
      EXPECT_EQ(after.volume[0][c], 0);
    }
  }
  EXPECT_LT(densest, 0.6);  // from 2.5 in one cell towards 0.5
}

TEST_F(TracersTest, RelaxationFollowsTheGradientOfTheExcessAndKeepsToItsLimit) {
  // The lower half holds more than the packing, the upper less; reach sqrt(D0 dt) much smaller than a cell.
  TracerSettings settings;
  settings.relaxation_coefficient = 1e-6;
  settings.relaxation_limit = 1;
  const std::vector<double> target(mesh_.cells(), 0.5);
  std::vector<double> volume(mesh_.cells());
  const auto packed = [](double z) { return 0.6 - 0.1 * z; };
  for (std::size_t c = 0; c < mesh_.cells(); ++c) volume[c] = packed(mesh_.cell_centre[c][2]) * mesh_.cell_volume[c];
  auto way = relaxation(mesh_, bed_, volume, target, settings, 1);
  for (std::size_t c = 0; c < mesh_.cells(); ++c) {
    const double z = mesh_.cell_centre[c][2];
    if (z < 0.25 || z > 1.15) continue;  // away from the ends of the bed
    EXPECT_NEAR(way[c][0], 0, 1e-12);
    EXPECT_NEAR(way[c][1], 0, 1e-12);
    EXPECT_NEAR(way[c][2], 1e-6 * 0.1 / packed(z), 1e-9);  // upwards, to where there is room
  }
  settings.relaxation_limit = 5e-8;
  way = relaxation(mesh_, bed_, volume, target, settings, 1);
  for (const Vector3& step : way) EXPECT_LE(std::hypot(step[0], step[1], step[2]), 5e-8 * (1 + 1e-12));
  const std::vector<bool> nowhere(mesh_.cells(), false);
  for (const Vector3& step : relaxation(mesh_, nowhere, volume, target, settings, 1)) EXPECT_EQ(step, Vector3{});
}

TEST_F(TracersTest, RelaxationAloneEvensOutAnExcess) {
  const CellLocator locator(mesh_);
  const PathField paths(mesh_, std::vector<double>(mesh_.faces(), 0.0), std::vector<double>(mesh_.cells(), 1.0));
  // A uniform bed in which the tracers of the upper half carry a fifth more.
  Tracers tracers;
  std::int64_t id = 0;
  for (std::size_t c = 0; c < mesh_.cells(); ++c) {
    if (!bed_[c]) continue;
    for (int k = 0; k < 27; ++k) {
      // Anywhere in the cell: tracers in rows would all cross a face at once.
      const auto at = random_uniform(3, RandomUse::seeding, static_cast<std::uint64_t>(id));
      const auto height = random_uniform(5, RandomUse::seeding, static_cast<std::uint64_t>(id));
      tracers.add(id++, 0, {static_cast<std::int64_t>(c), Vector3{at[0], at[1], height[0]}},
                  0.5 / 27 * mesh_.cell_volume[c] * (mesh_.cell_centre[c][2] > 0.7 ? 1.1 : 0.9), 1);
    }
  }
  TracerSettings settings;
  const std::vector<double> target(mesh_.cells(), 0.5);
  const std::vector<double> no_excess(mesh_.cells(), 0.0);
  const auto unevenness = [&] {
    const CellContents contents = sum_tracers(tracers, 1, mesh_.cells(), false, [](std::vector<double>&) {});
    std::vector<double> layer(7, 0.0);
    for (std::size_t c = 0; c < mesh_.cells(); ++c) {
      if (bed_[c]) layer[static_cast<std::size_t>(mesh_.cell_centre[c][2] / 0.2)] += contents.volume[0][c];
    }
    const auto [least, most] = std::minmax_element(layer.begin(), layer.end());
    return *most / *least - 1;
  };
  const double before = unevenness();
  for (long step = 0; step < 400; ++step) {
    const CellContents contents = sum_tracers(tracers, 1, mesh_.cells(), false, [](std::vector<double>&) {});
    displace(tracers, settings, locator, paths, bed_, no_excess, 0.25, 11, step,
             relaxation(mesh_, bed_, contents.volume[0], target, settings, 0.25));
  }
  EXPECT_NEAR(before, 1.1 / 0.9 - 1, 1e-9);
  EXPECT_LT(unevenness(), 0.5 * before);
}

TEST_F(TracersTest, DisplacementKeepsOutOfExcludedZones) {
  campaign_.species[1].softening = Softening{1475, 1675};
  campaign_.species[1].none_below = 0.3;
  std::vector<double> ore(mesh_.cells());
  for (std::size_t c = 0; c < mesh_.cells(); ++c) ore[c] = mesh_.cell_centre[c][2] > 0.8 ? 1000 : 1700;
  const auto height_of_lowest_excluded = [&](const std::vector<double>& temperature) {
    const auto displaced = displaced_cells(mesh_, campaign_, bed_, temperature);
    double lowest = 1.4;
    for (std::size_t c = 0; c < mesh_.cells(); ++c) {
      if (bed_[c] && !displaced[c]) lowest = std::min(lowest, mesh_.cell_centre[c][2]);
      if (!bed_[c]) {
        EXPECT_FALSE(displaced[c]);
      }
    }
    return lowest;
  };
  EXPECT_NEAR(height_of_lowest_excluded(ore), 0.9, 1e-12);
  EXPECT_NEAR(height_of_lowest_excluded(std::vector<double>(mesh_.cells(), 300)), 0.5, 1e-12);  // above none_below
  EXPECT_EQ(height_of_lowest_excluded({}), 1.4);                                                // nothing melts
  campaign_.tracer.displacement_excludes.above_cohesive_zone = false;
  EXPECT_EQ(height_of_lowest_excluded(ore), 1.4);
  campaign_.tracer.displacement_excludes.boxes = {{{{-1, -1, 0.6}, {1, 1, 0.75}}}};
  EXPECT_NEAR(height_of_lowest_excluded(ore), 0.7, 1e-12);
}

TEST(Ledger, ResidualsSeeWhatIsMissingAndSurviveACheckpoint) {
  Ledger ledger;
  ledger.mass_begin = 100;
  ledger.tally.enter(10, 50);
  ledger.tally.leave(Cause::melted, 4, 700);
  ledger.tally.leave(Cause::raceway, 3, 200);
  ledger.mass_now = 103;
  ledger.blast = 5000;
  ledger.top_gas = 1000;
  ledger.walls = 100;
  ledger.energy_begin = 1000;
  ledger.energy_now = 1000 + 5000 + 50 - 1000 - 100 - 900;
  EXPECT_NEAR(ledger.mass_residual(), 0, 1e-15);
  EXPECT_NEAR(ledger.energy_residual(), 0, 1e-15);
  const Ledger back = Ledger::from_row(ledger.row());
  EXPECT_EQ(back.row(), ledger.row());
  ledger.energy_now += 50;
  EXPECT_NEAR(ledger.energy_residual(), 0.01, 1e-12);
  ledger.mass_now -= 1;
  EXPECT_NEAR(ledger.mass_residual(), 0.01, 1e-12);
  EXPECT_EQ(ledger.to_json(true)["energy"]["melt"].get<double>(), 700);
  EXPECT_FALSE(ledger.to_json(false).contains("energy"));
}

}  // namespace
}  // namespace cupola
