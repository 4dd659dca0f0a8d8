#include <gtest/gtest.h>

#include <cstdio>

#include "physics/plan/charge.hpp"
#include "tests/support/tracer_program.hpp"
#include "tests/verification/tracer/column.hpp"

namespace cupola {
namespace {

constexpr std::size_t rows = 80;
constexpr double height = 2;

/// One species that descends through a box without heat loss, its conduction negligible, blown from below; drawn off in
/// the lowest tenth.
Campaign moving_bed(double tracers_per_cell) {
  const ReadCampaign read = read_campaign_text(R"yaml(
campaign: moving-bed
scene:
  geometry: {box: {width: 0.4 m, depth: 0.4 m, height: 2 m}}
  mesh: {cell: 0.025 m, cells: {half_width: 1, depth: 1, heights: [80]}}
  gas:
    species: air
    inlets: [{name: blast, side: bottom, mass_flow: 0.2 kg/s, total_temperature: 1200 K}]
species:
  pebble: {diameter: 30 mm, density: 1500 kg/m3, heat_capacity: 500 J/kg/K, conductivity: 1e-6 W/m/K}
contacts:
  pairs:
    pebble-pebble: {restitution: 0.5, friction: 0.5, rolling: 0.1}
    pebble-wall: {restitution: 0.5, friction: 0.3, rolling: 0.02}
heat: {nusselt_factor: 1}
charging: {stock_line: 2 m, temperature: 300 K, layers: [{pebble: 100 kg}]}
raceways: [{box: {x: [-0.2 m, 0.2 m], y: [-0.2 m, 0.2 m], z: [0 m, 0.2 m]}, void: 0.3, dem_removal_rate: 10 kg/s}]
descent_rate: 2 mm/s
dem: {stop: {at_most: 5 s}}
tracer: {duration: 5000 s, time_step: 5 s}
)yaml",
                                               "moving_bed.yaml");
  if (!read.ok()) throw std::runtime_error(to_text(read.errors));
  Campaign campaign = read.campaign;
  campaign.tracer.tracers_per_cell = tracers_per_cell;
  return campaign;
}

/// Slope of a least-squares line.
double slope_of(const std::vector<double>& x, const std::vector<double>& y) {
  double n = 0, sx = 0, sy = 0, sxx = 0, sxy = 0;
  for (std::size_t k = 0; k < x.size(); ++k) {
    n += 1;
    sx += x[k];
    sy += y[k];
    sxx += x[k] * x[k];
    sxy += x[k] * y[k];
  }
  return (n * sxy - sx * sy) / (n * sxx - sx * sx);
}

/// Counter-current moving bed: with constant exchange the difference of gas and solids follows
///   d(Tg - Ts)/dz = (Tg - Ts) h a (1/Cs - 1/Cg),
/// C the heat-capacity flows per area, z against the solids' motion.  The whole stage, tracers and gas, must give this
/// exponential.
void compare_with_the_exact_profile(double tracers_per_cell, double tolerance) {
  const Campaign campaign = moving_bed(tracers_per_cell);
  const testing::TracerProgram program(campaign);
  ASSERT_EQ(program.run(), 0) << program.failure();
  const FieldFile result = program.result();
  const auto gas = testing::row_means(program.mesh(), result.cell_data("gas_temperature"), height, rows);
  const auto solids = testing::row_means(program.mesh(), result.cell_data("solids_temperature"), height, rows);
  // Away from removal and stock plane.
  std::vector<double> at, logarithm;
  const std::size_t first = 16;
  const std::size_t last = 72;
  for (std::size_t k = first; k <= last; ++k) {
    ASSERT_GT(gas[k], solids[k]);
    at.push_back((static_cast<double>(k) + 0.5) * height / rows);
    logarithm.push_back(std::log(gas[k] - solids[k]));
  }
  const double slope = slope_of(at, logarithm);

  const Species& pebble = campaign.species[0];
  const double exchange = testing::volumetric_exchange(campaign, testing::blast_flux(campaign), expected_packing);
  const double gas_flow = testing::blast_flux(campaign) * campaign.scene.gas->heat_capacity;
  const double solids_flow = campaign.descent_rate * expected_packing * pebble.density * pebble.heat_capacity.at(300);
  const double exact = exchange * (1 / solids_flow - 1 / gas_flow);
  std::printf("slope of the logarithm %.5f 1/m, exact %.5f: %.2g of it\n", slope, exact, slope / exact - 1);
  EXPECT_NEAR(slope, exact, tolerance * exact);
  // What one gives the other takes, between two faces, where the means of the cells meet.
  const auto at_face = [](const std::vector<double>& mean, std::size_t k) { return 0.5 * (mean[k] + mean[k + 1]); };
  const double given = gas_flow * (at_face(gas, first) - at_face(gas, last));
  EXPECT_NEAR(given, solids_flow * (at_face(solids, first) - at_face(solids, last)), 0.02 * given);
  EXPECT_LT(result.summary()["ledger"]["energy"]["residual"].get<double>(), 1e-9);
}

TEST(CounterCurrent, MarchedProfileIsTheExactExponential) { compare_with_the_exact_profile(40, 0.005); }
TEST(LongCounterCurrent, MoreTracersComeNearer) { compare_with_the_exact_profile(640, 0.001); }

}  // namespace
}  // namespace cupola
