#include "physics/projection/cell_spreading.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numeric>

#include "tests/support/box_mesh.hpp"

namespace cupola {
namespace {

/// A slot like the furnaces': narrower at the bottom, graded upwards, periodic in y.
BedMesh slanted_slot() {
  testing::BoxMesh box{{8, 4, 12}, {-1, -0.3, 0}, {1, 0.3, 3}, true};
  box.deform = [](const Vector3& p) { return Vector3{p[0] * (1 + 0.3 * p[2]), p[1], p[2] + 0.1 * p[2] * p[2]}; };
  return box.make();
}

std::vector<double> numbers(std::size_t count, double phase) {
  std::vector<double> values(count);
  for (std::size_t i = 0; i < count; ++i) values[i] = 1 + std::sin(static_cast<double>(i) * 1.7 + phase);
  return values;
}

double total(const std::vector<double>& values) { return std::accumulate(values.begin(), values.end(), 0.0); }

TEST(CellSpreading, ConservesWhatItSpreads) {
  const BedMesh mesh = slanted_slot();
  const CellSpreading spreading(mesh, {}, 0.8);
  EXPECT_GT(spreading.passes(), 1);
  auto sums = numbers(mesh.cells(), 0);
  const double before = total(sums);
  spreading.apply(sums);
  EXPECT_NEAR(total(sums), before, 1e-13 * before);
}

TEST(CellSpreading, WeightsAreNeverNegative) {
  const BedMesh mesh = slanted_slot();
  const CellSpreading spreading(mesh, {}, 1.5);
  std::vector<double> one(mesh.cells(), 0);
  one[mesh.cells() / 2] = 1;
  spreading.apply(one);
  for (const double weight : one) EXPECT_GE(weight, 0);
}

TEST(CellSpreading, GatheringIsTheTransposeOfSpreading) {
  const BedMesh mesh = slanted_slot();
  const CellSpreading spreading(mesh, {}, 0.8);
  const auto sums = numbers(mesh.cells(), 0), values = numbers(mesh.cells(), 2);
  auto spread = sums, gathered = values;
  spreading.apply(spread);
  spreading.gather(gathered);
  const double one = std::inner_product(values.begin(), values.end(), spread.begin(), 0.0);
  const double other = std::inner_product(gathered.begin(), gathered.end(), sums.begin(), 0.0);
  EXPECT_NEAR(one, other, 1e-13 * std::abs(one));
}

TEST(CellSpreading, IsSymmetricInVolume) {
  const BedMesh mesh = slanted_slot();
  const CellSpreading spreading(mesh, {}, 0.8);
  const std::size_t one = 5, other = 13;
  std::vector<double> from_one(mesh.cells(), 0), from_other(mesh.cells(), 0);
  from_one[one] = 1;
  from_other[other] = 1;
  spreading.apply(from_one);
  spreading.apply(from_other);
  ASSERT_GT(from_one[other], 0);
  EXPECT_NEAR(from_one[other] * mesh.cell_volume[one], from_other[one] * mesh.cell_volume[other],
              1e-14 * mesh.cell_volume[one]);
}

TEST(CellSpreading, UniformDensityStaysAndGatheredConstantStays) {
  const BedMesh mesh = slanted_slot();
  const CellSpreading spreading(mesh, {}, 0.8);
  auto volumes = mesh.cell_volume;
  spreading.apply(volumes);
  std::vector<double> constant(mesh.cells(), 7);
  spreading.gather(constant);
  for (std::size_t cell = 0; cell < mesh.cells(); ++cell) {
    EXPECT_NEAR(volumes[cell], mesh.cell_volume[cell], 1e-14 * mesh.cell_volume[cell]);
    EXPECT_NEAR(constant[cell], 7, 1e-13);
  }
}

TEST(CellSpreading, VarianceIsThatOfASphere) {
  const BedMesh mesh = testing::BoxMesh{{21, 21, 21}, {0, 0, 0}, {1.05, 1.05, 1.05}}.make();
  const double diameter = 0.2;
  const CellSpreading spreading(mesh, {}, diameter);
  const std::size_t middle = (10 * 21 + 10) * 21 + 10;
  std::vector<double> one(mesh.cells(), 0);
  one[middle] = 1;
  spreading.apply(one);
  for (std::size_t axis = 0; axis < 3; ++axis) {
    double variance = 0;
    for (std::size_t cell = 0; cell < mesh.cells(); ++cell) {
      variance += one[cell] * std::pow(mesh.cell_centre[cell][axis] - mesh.cell_centre[middle][axis], 2);
    }
    EXPECT_NEAR(variance, diameter * diameter / 20, 1e-12);
  }
}

TEST(CellSpreading, SpreadsAcrossPeriodicSides) {
  const BedMesh mesh = testing::BoxMesh{{1, 5, 1}, {0, 0, 0}, {1, 5, 1}, true}.make();
  const CellSpreading spreading(mesh, {}, 2);
  std::vector<double> one(mesh.cells(), 0);
  one[0] = 1;
  spreading.apply(one);
  EXPECT_GT(one[4], 0);
  EXPECT_NEAR(one[4], one[1], 1e-15);
}

TEST(CellSpreading, StaysInsideTheGivenCells) {
  const BedMesh mesh = slanted_slot();
  std::vector<bool> bed(mesh.cells());
  for (std::size_t cell = 0; cell < mesh.cells(); ++cell) bed[cell] = mesh.cell_centre[cell][2] < 2;
  const CellSpreading spreading(mesh, bed, 0.8);
  auto sums = numbers(mesh.cells(), 0);
  const auto before = sums;
  spreading.apply(sums);
  double inside_before = 0, inside = 0;
  for (std::size_t cell = 0; cell < mesh.cells(); ++cell) {
    if (bed[cell]) {
      inside_before += before[cell];
      inside += sums[cell];
    } else {
      EXPECT_EQ(sums[cell], before[cell]);
    }
  }
  EXPECT_NEAR(inside, inside_before, 1e-13 * inside);
}

TEST(CellSpreading, HeatIsTheSameOnBothSides) {
  // Tracers of one cell each, conductances spread to the gas; what the gas loses is what the tracers gain.
  const BedMesh mesh = slanted_slot();
  const CellSpreading spreading(mesh, {}, 0.8);
  const auto tracer_conductance = numbers(mesh.cells(), 0);
  const auto coefficient = numbers(mesh.cells(), 1), gas_temperature = numbers(mesh.cells(), 2),
             solid = numbers(mesh.cells(), 3);
  auto spread = tracer_conductance, spread_temperature = tracer_conductance;
  for (std::size_t cell = 0; cell < mesh.cells(); ++cell) spread_temperature[cell] *= solid[cell];
  spreading.apply(spread);
  spreading.apply(spread_temperature);
  double gas_side = 0;
  for (std::size_t cell = 0; cell < mesh.cells(); ++cell) {
    gas_side += coefficient[cell] * (spread[cell] * gas_temperature[cell] - spread_temperature[cell]);
  }
  auto seen_coefficient = coefficient;
  spreading.gather(seen_coefficient);
  const auto seen_temperature = spreading.gather(gas_temperature, coefficient);
  double solid_side = 0;
  for (std::size_t cell = 0; cell < mesh.cells(); ++cell) {
    solid_side += tracer_conductance[cell] * seen_coefficient[cell] * (seen_temperature[cell] - solid[cell]);
  }
  EXPECT_NEAR(gas_side, solid_side, 1e-12 * std::abs(gas_side) + 1e-12);
}

}  // namespace
}  // namespace cupola
