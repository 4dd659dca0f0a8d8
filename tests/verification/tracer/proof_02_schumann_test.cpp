#include <gtest/gtest.h>

#include <array>
#include <cstdio>

#include "tests/support/tracer_program.hpp"
#include "tests/verification/tracer/column.hpp"
#include "tests/verification/tracer/schumann.hpp"

namespace cupola {
namespace {

constexpr double solids_fraction = 0.6;
constexpr double units = 12;  // transfer units of the whole column, so that Y = 10 lies inside

struct Point {
  double y, z, gas, solids;
};
/// REFERENCE_CASES, after Schumann 1929.
constexpr std::array<Point, 6> published{{{1, 1, 0.654254, 0.345746},
                                          {2, 2, 0.603501, 0.396499},
                                          {5, 5, 0.563917, 0.436083},
                                          {10, 10, 0.544890, 0.455110},
                                          {5, 10, 0.925608, 0.880206},
                                          {10, 5, 0.119794, 0.074392}}};

/// The column whose blast passes `units` transfer units, and its unit of time, s.
Campaign bed(int rows) {
  Campaign campaign = testing::column_campaign(rows);
  // Transfer units fall as the flow grows: bisect.
  double low = 1e-3;
  double high = 10;
  for (int k = 0; k < 100; ++k) {
    const double middle = std::sqrt(low * high);
    campaign.scene.gas->inlets[0].mass_flow = middle;
    const double flux = testing::blast_flux(campaign);
    const double found =
        testing::volumetric_exchange(campaign, flux, solids_fraction) / (flux * campaign.scene.gas->heat_capacity);
    (found > units ? low : high) = middle;
  }
  return campaign;
}

double unit_of_time(const Campaign& campaign) {
  const Species& pebble = campaign.species[0];
  return solids_fraction * pebble.density * pebble.heat_capacity.at(300) /
         testing::volumetric_exchange(campaign, testing::blast_flux(campaign), solids_fraction);
}

/// A march on the column that stops at a dimensionless time.
class Column {
 public:
  explicit Column(int rows)
      : rows_(rows), program_(bed(rows), [](const BedMesh& mesh, const Campaign& campaign) {
          return testing::bed_at_rest(mesh, campaign, solids_fraction);
        }) {}

  /// Solids (of 1) at each Y when Z has passed in `steps` steps a unit.
  std::vector<double> solids(double z, int steps, const std::vector<double>& ys) {
    march(z, z / (z * steps));
    const testing::FinalTracers tracers = program_.tracers();
    return at(tracers.temperature, ys);  // one tracer a cell, in the cells' order
  }

  /// Gas, which belongs to the middle of the last step: half a step more is marched.
  std::vector<double> gas(double z, int steps, const std::vector<double>& ys) {
    const double step = z / (z * steps + 0.5);
    march(z + step / 2, step);
    return at(program_.result().cell_data("gas_temperature"), ys);
  }

  /// Largest error of gas and solids at the published points of this Z.
  double error(double z, int steps) {
    std::vector<double> ys;
    for (const Point& point : published) {
      if (point.z == z) ys.push_back(point.y);
    }
    const auto found_gas = gas(z, steps, ys);
    const auto found_solids = solids(z, steps, ys);
    double largest = 0;
    std::size_t k = 0;
    for (const Point& point : published) {
      if (point.z != z) continue;
      std::printf("%3d rows, %2d steps a unit, (Y, Z) = (%2g, %2g): gas %.6f (%.6f), solids %.6f (%.6f)\n", rows_,
                  steps, point.y, point.z, found_gas[k], point.gas, found_solids[k], point.solids);
      largest = std::max({largest, std::abs(found_gas[k] - point.gas), std::abs(found_solids[k] - point.solids)});
      ++k;
    }
    return largest;
  }

 private:
  void march(double z, double step) {
    Campaign campaign = bed(rows_);
    const double second = unit_of_time(campaign);
    campaign.tracer.duration = z * second;
    campaign.tracer.time_step = step * second;
    program_.march_anew(campaign);
    EXPECT_EQ(program_.run(), 0) << program_.failure();
  }
  [[nodiscard]] std::vector<double> at(const std::vector<double>& field, const std::vector<double>& ys) const {
    const auto mean = testing::row_means(program_.mesh(), field, 1, static_cast<std::size_t>(rows_));
    const double dy = units / rows_;
    std::vector<double> result;
    for (const double y : ys) result.push_back((testing::interpolate(mean, dy / 2, dy, y) - 300) / 1000);
    return result;
  }

  int rows_;
  testing::TracerProgram program_;
};

TEST(Schumann, PublishedPointsAreTheSeriesOwn) {
  for (const Point& point : published) {
    EXPECT_NEAR(testing::schumann_gas(point.y, point.z), point.gas, 6e-7);
    EXPECT_NEAR(testing::schumann_solids(point.y, point.z), point.solids, 6e-7);
  }
}

TEST(Schumann, SixPoints) {
  Column column(96);
  for (const double z : {1.0, 2.0, 5.0, 10.0}) EXPECT_LT(column.error(z, 8), 2e-3) << "Z = " << z;
}

/// Cells and steps refined together.
TEST(Schumann, SecondOrderUnderRefinement) {
  std::vector<double> error;
  int steps = 2;
  for (const int rows : {24, 48, 96}) {
    Column column(rows);
    error.push_back(column.error(5, steps));
    steps *= 2;
  }
  for (std::size_t k = 1; k < error.size(); ++k) {
    const double order = std::log2(error[k - 1] / error[k]);
    std::printf("error %.3g to %.3g: order %.2f\n", error[k - 1], error[k], order);
    EXPECT_GT(order, 1.8);
  }
}

}  // namespace
}  // namespace cupola
