#include <gtest/gtest.h>

#include <cstdio>
#include <random>

#include "tests/support/tracer_program.hpp"
#include "tests/verification/tracer/column.hpp"

namespace cupola {
namespace {

constexpr double solids_fraction = 0.5;
constexpr int cells_across = 4;

/// A cold cube of 1 m with 64 cells and solids at rest that the random displacement alone moves.
Campaign cube(int steps, double step) {
  Campaign campaign = testing::column_campaign(cells_across);
  campaign.heat.reset();
  campaign.scene.gas.reset();
  campaign.dem.gas = DemSettings::GasModel::none;
  campaign.scene.geometry.profile = {{0, 0.5}, {1, 0.5}};
  campaign.scene.geometry.depth = 1;
  campaign.scene.mesh.cells->half_width = cells_across / 2;
  campaign.scene.mesh.cells->depth = cells_across;
  TracerSettings& tracer = campaign.tracer;
  tracer.gas = TracerSettings::GasModel::none;
  tracer.displacement = TracerSettings::Displacement::random;
  tracer.displacement_excludes.above_cohesive_zone = false;
  tracer.tracers_per_cell = 1;
  tracer.duration = steps * step;
  tracer.time_step = step;
  return campaign;
}

/// Independent tracers, evenly distributed over the cube, of `packing` times the solids fraction that the field states.
testing::StatedBed scattered(const BedMesh& mesh, const Campaign& campaign, std::size_t tracers, double packing) {
  testing::StatedBed bed = testing::bed_at_rest(mesh, campaign, solids_fraction);
  testing::StatedBed result;
  result.solids_fraction = bed.solids_fraction;
  result.solids_velocity = bed.solids_velocity;
  std::mt19937_64 engine(7);
  const auto uniform = [&] { return static_cast<double>(engine() >> 11) * 0x1p-53; };
  const double mass = packing * solids_fraction / static_cast<double>(tracers) * campaign.species[0].density;
  for (std::size_t i = 0; i < tracers; ++i) {
    const double x = uniform() - 0.5;
    const double y = uniform() - 0.5;
    result.add_parcel(0, {x, y, uniform()}, 1e-9, mass);
  }
  return result;
}

/// Where there are twice the tracers that the field has room for, the excess is 1/2 and tracers diffuse with half the
/// coefficient: their mean square displacement along each axis is 2 (D0/2) t.
TEST(Displacement, DiffusesWithTheCoefficientPutIn) {
  const int steps = 20;
  const double step = 0.5;
  const Campaign campaign = cube(steps, step);
  constexpr std::size_t tracers = 32000;
  testing::StatedBed begin;
  const testing::TracerProgram program(
      campaign, [&](const BedMesh& mesh, const Campaign& c) { return begin = scattered(mesh, c, tracers, 2); });
  ASSERT_EQ(program.run(), 0) << program.failure();
  const testing::FinalTracers end = program.tracers();  // in the order of the parcels
  ASSERT_EQ(end.id.size(), tracers);
  Vector3 square{};
  double count = 0;
  for (std::size_t i = 0; i < tracers; ++i) {
    // Far from walls, as seen at the beginning.
    const Vector3& from = begin.position[i];
    if (std::abs(from[0]) > 0.3 || std::abs(from[1]) > 0.3 || std::abs(from[2] - 0.5) > 0.3) continue;
    ++count;
    for (std::size_t k = 0; k < 3; ++k) square[k] += std::pow(end.position[i][k] - from[k], 2);
  }
  const double seconds = steps * step;
  const double put_in = campaign.tracer.displacement_coefficient / 2;
  for (std::size_t k = 0; k < 3; ++k) {
    const double found = square[k] / count / (2 * seconds);
    std::printf("axis %zu: D %.4g m2/s, put in %.4g (%.2g standard errors)\n", k, found, put_in,
                (found / put_in - 1) / std::sqrt(2 / count));
    // Four standard errors, and what the tracers' own fluctuations take from the excess.
    EXPECT_NEAR(found, put_in, put_in * (4 * std::sqrt(2 / count) + 0.01));
  }
}

/// Chi-square of the tracers in `parts` equal parts along an axis, over its expectation.
double unevenness(const testing::FinalTracers& tracers, std::size_t axis, double from, std::size_t parts) {
  std::vector<double> counted(parts, 0.0);
  for (const Vector3& position : tracers.position) {
    const auto part = static_cast<std::size_t>((position[axis] - from) * static_cast<double>(parts));
    counted[std::min(part, parts - 1)] += 1;
  }
  const double expected = static_cast<double>(tracers.id.size()) / static_cast<double>(parts);
  double chi_square = 0;
  for (const double n : counted) chi_square += (n - expected) * (n - expected) / expected;
  return chi_square / static_cast<double>(parts - 1);
}

void stays_uniform(int steps) {
  const Campaign campaign = cube(steps, 5);
  constexpr std::size_t count = 3200;
  testing::StatedBed begin;
  const testing::TracerProgram program(
      campaign, [&](const BedMesh& mesh, const Campaign& c) { return begin = scattered(mesh, c, count, 1); });
  ASSERT_EQ(program.run(), 0) << program.failure();
  const testing::FinalTracers tracers = program.tracers();
  ASSERT_EQ(tracers.id.size(), count);
  double moved = 0;
  for (std::size_t i = 0; i < count; ++i) moved += std::abs(tracers.position[i][2] - begin.position[i][2]) / count;
  std::printf("%d steps: tracers have moved by %.2g m on average\n", steps, moved);
  EXPECT_GT(moved, 0.1);  // tracers do wander, through several cells
  EXPECT_EQ(program.result().summary()["ledger"]["mass"]["out"]["lost"].get<double>(), 0);
  // In slabs of half a cell and less a drift to walls, corners or cell faces would show.
  for (const std::size_t parts : {4u, 8u, 16u}) {
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const double found = unevenness(tracers, axis, axis == 2 ? 0 : -0.5, parts);
      std::printf("%d steps, axis %zu in %zu parts: chi square %.2f of that of independent tracers\n", steps, axis,
                  parts, found);
      EXPECT_LT(found, 1 + 4 * std::sqrt(2.0 / static_cast<double>(parts - 1)));
    }
  }
}

TEST(Displacement, UniformBedStaysUniform) { stays_uniform(3000); }
TEST(LongDisplacement, UniformBedStaysUniformFor100000Steps) { stays_uniform(100000); }

}  // namespace
}  // namespace cupola
