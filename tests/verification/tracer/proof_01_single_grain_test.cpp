#include <gtest/gtest.h>

#include <cstdio>
#include <numbers>

#include "schemas/files.hpp"
#include "tests/support/tracer_program.hpp"
#include "tests/verification/tracer/column.hpp"

namespace cupola {
namespace {

/// The stream of the reference in a duct 2 m by 2 m with one grain in it.
Campaign one_grain_in_a_stream() {
  Campaign campaign = testing::column_campaign(4);
  campaign.scene.geometry.profile = {{0, 1}, {1, 1}};
  campaign.scene.geometry.depth = 2;
  Gas& gas = *campaign.scene.gas;
  gas.heat_capacity = 999.06;
  gas.viscosity = 1.8603e-5;
  gas.prandtl = gas.viscosity * gas.heat_capacity / 0.051865;
  gas.inlets[0].mass_flow = 1.1854 * 6 * 4;
  gas.inlets[0].total_temperature = 298.15;
  Species& grain = campaign.species[0];
  grain.diameter = 3.6e-3;
  grain.density = 8850;
  grain.heat_capacity = 55.0;
  campaign.charging.temperature = 373.15;
  campaign.tracer.duration = 1;
  return campaign;
}

/// The field states a thin suspension, which the flow needs; of its grains one is there.
testing::StatedBed one_grain(const BedMesh& mesh, const Campaign& campaign) {
  const double volume = std::numbers::pi / 6 * std::pow(campaign.species[0].diameter, 3);
  const testing::StatedBed bed = testing::bed_at_rest(mesh, campaign, 0.01);
  testing::StatedBed one;
  one.solids_fraction = bed.solids_fraction;
  one.solids_velocity = bed.solids_velocity;
  one.add_parcel(0, {0.3, 0.2, 0.4}, campaign.species[0].diameter / 2, volume * campaign.species[0].density);
  return one;
}

/// REFERENCE: a sphere of 3.6 mm cools in air of 6 m/s, Ranz-Marshall, lumped: T = T_g + (T_0 - T_g) exp(-t/1.1381 s).
TEST(SingleGrain, CoolsInAStreamAsTheLumpedSphere) {
  testing::TracerProgram program(one_grain_in_a_stream(), one_grain);
  double largest = 0;
  for (const double step : {0.1, 0.5, 1.0}) {
    Campaign campaign = one_grain_in_a_stream();
    campaign.tracer.time_step = step;
    program.march_anew(campaign);
    ASSERT_EQ(program.run(), 0) << program.failure();
    const std::vector<std::pair<double, double>> published{{0.1, 366.8415}, {0.5, 346.4858}, {1.0, 329.3014}};
    int compared = 0;
    for (const auto& line : read_history(program.path())) {
      for (const auto& [time, temperature] : published) {
        if (std::abs(line["time"].get<double>() - time) > 1e-9) continue;
        const double found = line["mean_solid_temperature"].get<double>();
        EXPECT_NEAR(found, temperature, 1e-4 * (temperature - 298.15)) << "after " << time << " s, step " << step;
        largest = std::max(largest, std::abs(found - temperature) / (temperature - 298.15));
        ++compared;
      }
    }
    EXPECT_EQ(compared, step < 0.2 ? 3 : (step < 0.7 ? 2 : 1));
    // The grain's tracers.
    for (const double found : program.tracers().temperature) EXPECT_NEAR(found, 329.3014, 1e-4 * (329.3014 - 298.15));
  }
  std::printf("largest error relative to T - T_gas: %.2g\n", largest);
}

}  // namespace
}  // namespace cupola
