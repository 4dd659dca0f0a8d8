#include <gtest/gtest.h>

#include <cstdio>
#include <numbers>

#include "physics/closures/carson.hpp"
#include "tests/support/tracer_program.hpp"
#include "tests/verification/tracer/column.hpp"

namespace cupola {
namespace {

constexpr int rows = 20;
constexpr double solids_fraction = 0.58;  // Beaulieu 2020: void 0.42
constexpr double hot = 600;
constexpr double cold = 300;
constexpr double plate = 1e5;  // heat capacity of a plate's row over a bed's row

/// Steel spheres at rest in a gas that exchanges next to nothing with them; the lowest and the highest row are plates:
/// so heavy that their temperature stays.
Campaign steel_bed() {
  Campaign campaign = testing::column_campaign(rows);
  campaign.heat->nusselt_factor = 1e-12;
  campaign.scene.gas->inlets[0].mass_flow = 1e-9;
  Species& steel = campaign.species[0];
  steel.diameter = 0.02e-3;  // so small beside a cell that the kernel of a parcel keeps the plates apart from the bed
  steel.density = 7747;
  steel.heat_capacity = 464;
  steel.conductivity = 42;
  return campaign;
}

testing::StatedBed between_plates(const BedMesh& mesh, const Campaign& campaign) {
  testing::StatedBed bed = testing::bed_at_rest(mesh, campaign, solids_fraction);
  for (std::size_t p = 0; p < bed.mass.size(); ++p) {
    const double z = bed.position[p][2];
    if (z < 1.0 / rows || z > 1 - 1.0 / rows) bed.mass[p] *= plate;
  }
  return bed;
}

/// A tracer result that says no more than the temperature of the solids in each cell.
void write_temperature(const testing::TracerProgram& program, const std::filesystem::path& file,
                       const std::vector<double>& temperature) {
  const FieldFile granular(program.path() / "granular.hdf", "dem-result");
  FieldFileWriter out(file, {"tracer-result", granular.header().campaign_hash, program.mesh().hash}, granular.points(),
                      granular.cell_points());
  out.cell_data("solids_temperature", temperature);
  out.cell_data("solids_temperature.pebble", temperature);
  out.commit();
}

double diffusivity(const Campaign& campaign) {
  const Species& steel = campaign.species[0];
  return bed_conductivity_carson(steel.conductivity.at(300), solids_fraction) /
         (solids_fraction * steel.density * steel.heat_capacity.at(300));
}

/// Rows of the bed `times` (diffusion times of the bed's height between the plates' middles) after the plates got hot
/// and cold, in `steps` steps.
std::vector<double> marched(testing::TracerProgram& program, double times, int steps) {
  Campaign campaign = steel_bed();
  const double height = 1 - 1.0 / rows;
  campaign.tracer.duration = times * height * height / diffusivity(campaign);
  campaign.tracer.time_step = campaign.tracer.duration / steps;
  program.march_anew(campaign);
  std::vector<double> begin(program.mesh().cells(), cold);
  for (std::size_t c = 0; c < begin.size(); ++c) {
    if (program.mesh().cell_centre[c][2] < 1.0 / rows) begin[c] = hot;
  }
  write_temperature(program, program.path() / "begin.hdf", begin);
  program.begin_from(program.path() / "begin.hdf");
  EXPECT_EQ(program.run(), 0) << program.failure();
  return testing::row_means(program.mesh(), program.tracers().temperature, 1, rows);
}

/// Fourier's series for a slab at `cold` whose one side is brought to `hot` at time 0: x from the hot side over the
/// height, time in height^2/diffusivity.
double exact(double x, double time) {
  double value = hot + (cold - hot) * x;
  for (int n = 1; n < 200; ++n) {
    const double k = n * std::numbers::pi;
    value -= 2 * (hot - cold) / k * std::sin(k * x) * std::exp(-k * k * time);
  }
  return value;
}

double largest_error(const std::vector<double>& row, double time) {
  double largest = 0;
  for (int k = 1; k + 1 < rows; ++k) {
    largest = std::max(largest, std::abs(row[static_cast<std::size_t>(k)] - exact(k / (rows - 1.0), time)));
  }
  return largest / (hot - cold);
}

TEST(Conduction, BetweenTwoPlatesIsFouriersSeries) {
  testing::TracerProgram program(steel_bed(), between_plates);
  for (const double time : {0.05, 0.2}) {
    const double error = largest_error(marched(program, time, 100), time);
    std::printf("after %g diffusion times: largest error %.2g of the difference of the plates\n", time, error);
    EXPECT_LT(error, 0.01);
  }
}

TEST(Conduction, SteadyStateIsLinearAndThePlateGivesCarsonsFlux) {
  testing::TracerProgram program(steel_bed(), between_plates);
  const double times = 4;
  const auto row = marched(program, times, 60);
  EXPECT_LT(largest_error(row, 1e9), 2e-3);
  // Heat from plate to plate once steady, from what the cold plate took in the last half of the march.
  const auto before = marched(program, times / 2, 30);
  const Campaign campaign = steel_bed();
  const Species& steel = campaign.species[0];
  const double cell = 1.0 / rows;
  const double seconds = times / 2 * (1 - cell) * (1 - cell) / diffusivity(campaign);
  const double capacity = plate * solids_fraction * cell * steel.density * steel.heat_capacity.at(300);  // per area
  const double flux = capacity * (row[rows - 1] - before[rows - 1]) / seconds;
  const double found = flux * (1 - cell) / (hot - cold);
  const double carson = 42 * (3 * 0.58 - 1) / 2;
  std::printf("bed conductivity %.5f W/m/K, Carson %.5f\n", found, carson);
  EXPECT_NEAR(found, carson, 2e-3 * carson);
}

/// Effective-medium theory of two phases (Landauer 1952; Carson et al. 2005, eq. for the grains as continuous phase).
double effective_medium(double solid, double gas, double solids) {
  const double b = (3 * solids - 1) * solid + (3 * (1 - solids) - 1) * gas;
  return (b + std::sqrt(b * b + 8 * solid * gas)) / 4;
}

TEST(Conduction, CarsonIsTheCurveOfEffectiveMediumTheoryWithoutGas) {
  for (const double conductivity : {1.7, 42.0, 80.0}) {
    for (double solids = 0.05; solids <= 1; solids += 0.05) {
      EXPECT_NEAR(bed_conductivity_carson(conductivity, solids), effective_medium(conductivity, 0, solids),
                  1e-12 * conductivity);
    }
  }
  // MODEL 16: ore 27, coke 0.58 W/m/K at 0.56.
  EXPECT_NEAR(bed_conductivity_carson(80, 0.56), 27, 0.5);
  EXPECT_NEAR(bed_conductivity_carson(1.7, 0.56), 0.58, 0.005);
}

}  // namespace
}  // namespace cupola
