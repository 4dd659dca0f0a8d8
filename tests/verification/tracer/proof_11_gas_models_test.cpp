#include <gtest/gtest.h>

#include <cstdio>

#include "schemas/campaign_reader.hpp"
#include "tests/support/tracer_program.hpp"

namespace cupola {
namespace {

/// The slot of cases/tiny with its two tuyeres and raceways.
Campaign slot(TracerSettings::GasModel model) {
  Campaign campaign = load_campaign(std::filesystem::path(CUPOLA_SOURCE_DIR) / "cases" / "tiny" / "campaign.yaml");
  campaign.tracer.duration = 120;
  campaign.tracer.time_step = 10;
  campaign.tracer.gas = model;
  return campaign;
}

struct Fields {
  std::vector<double> gas_temperature, solids_temperature, pressure, flux;
};

Fields marched(testing::TracerProgram& program, TracerSettings::GasModel model) {
  program.march_anew(slot(model));
  EXPECT_EQ(program.run(), 0) << program.failure();
  const FieldFile result = program.result();
  return {result.cell_data("gas_temperature"), result.cell_data("solids_temperature"), result.cell_data("gas_pressure"),
          result.cell_data("gas_mass_flux", 3)};
}

/// rms of a - b over rms of a - zero, in the cells taken.
double difference(const std::vector<double>& a, const std::vector<double>& b, double zero,
                  const std::vector<bool>& taken, std::size_t columns = 1) {
  double square = 0;
  double scale = 0;
  for (std::size_t i = 0; i < a.size(); ++i) {
    if (!taken[i / columns]) continue;
    square += (a[i] - b[i]) * (a[i] - b[i]);
    scale += (a[i] - zero) * (a[i] - zero);
  }
  return std::sqrt(square / scale);
}

/// Darcy and Forchheimer leave out the gas's inertia: it matters in front of the tuyeres and hardly in the bed above.
TEST(GasModels, AgreeOnTheSlot) {
  testing::TracerProgram program(slot(TracerSettings::GasModel::darcy_forchheimer));
  const Fields darcy = marched(program, TracerSettings::GasModel::darcy_forchheimer);
  const Fields full = marched(program, TracerSettings::GasModel::navier_stokes);
  const BedMesh& mesh = program.mesh();
  const Campaign campaign = slot(TracerSettings::GasModel::darcy_forchheimer);
  std::vector<bool> bed(mesh.cells()), shaft(mesh.cells());
  for (std::size_t c = 0; c < mesh.cells(); ++c) {
    bed[c] = mesh.cell_centre[c][2] < campaign.charging.stock_line;
    shaft[c] = bed[c] && mesh.cell_centre[c][2] > 1;
  }
  const double outlet = campaign.scene.gas->outlet_pressure;
  const double solids = difference(full.solids_temperature, darcy.solids_temperature, 293, bed);
  const double gas = difference(full.gas_temperature, darcy.gas_temperature, 293, bed);
  const double flux = difference(full.flux, darcy.flux, 0, bed, 3);
  const double flux_in_shaft = difference(full.flux, darcy.flux, 0, shaft, 3);
  const double pressure = difference(full.pressure, darcy.pressure, outlet, bed);
  std::printf(
      "of the fields themselves: solids temperature %.2g, gas temperature %.2g, pressure rise %.2g, mass flux %.2g "
      "(above z = 1 m %.2g)\n",
      solids, gas, pressure, flux, flux_in_shaft);
  EXPECT_LT(solids, 0.01);
  EXPECT_LT(gas, 0.1);
  EXPECT_LT(flux_in_shaft, 0.02);
  EXPECT_LT(pressure, 0.02);
  // They are two models: inertia shows where the gas enters.
  EXPECT_GT(flux, 2 * flux_in_shaft);
}

}  // namespace
}  // namespace cupola
