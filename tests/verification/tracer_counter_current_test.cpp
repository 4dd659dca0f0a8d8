#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>

#include "physics/closures/gas_properties.hpp"
#include "physics/closures/ranz_marshall.hpp"
#include "physics/mesh/bed_mesh.hpp"
#include "physics/plan/charge.hpp"
#include "schemas/campaign_reader.hpp"
#include "schemas/field_file.hpp"
#include "schemas/files.hpp"
#include "tests/support/settled_bed.hpp"
#include "tests/support/temporary_folder.hpp"

namespace cupola {
namespace {

/// One species that descends through a box without heat loss, its conduction negligible, blown from below; removed in
/// the lowest cells.
const char* const moving_bed = R"yaml(
campaign: moving-bed
scene:
  geometry: {box: {width: 0.4 m, depth: 0.4 m, height: 2 m}}
  mesh: {cell: 0.025 m, cells: {half_width: 2, depth: 4, heights: [80]}}
  gas:
    species: air
    inlets: [{name: blast, side: bottom, mass_flow: 0.2 kg/s, total_temperature: 1200 K}]
species:
  pebble: {diameter: 30 mm, coarse_graining: 2, density: 1500 kg/m3, heat_capacity: 500 J/kg/K, conductivity: 1e-6 W/m/K}
contacts:
  pairs:
    pebble-pebble: {restitution: 0.5, friction: 0.5, rolling: 0.1}
    pebble-wall: {restitution: 0.5, friction: 0.3, rolling: 0.02}
heat: {nusselt_factor: 1}
charging: {stock_line: 2 m, temperature: 300 K, layers: [{pebble: 20 kg}]}
raceways: [{box: {x: [-0.2 m, 0.2 m], y: [-0.2 m, 0.2 m], z: [0 m, 0.2 m]}, void: 0.3, dem_removal_rate: 10 kg/s}]
descent_rate: 2 mm/s
dem: {stop: {at_most: 5 s}}
tracer: {duration: 5000 s, time_step: 5 s, tracers_per_cell: 5}
)yaml";

/// Counter-current moving bed (REFERENCE_CASES 2): with constant exchange the difference gas - solids follows
///   d(Tg - Ts)/dz = (Tg - Ts) h a (1/Cs - 1/Cg),
/// C the heat-capacity flows per area, z against the solids' motion.  The whole stage, tracers and gas, must give this
/// exponential.
TEST(TracerCounterCurrent, MarchedProfileIsTheExactExponential) {
  const ReadCampaign read = read_campaign_text(moving_bed, "moving_bed.yaml");
  ASSERT_TRUE(read.ok()) << to_text(read.errors);
  const Campaign& campaign = read.campaign;
  const TemporaryFolder folder;
  Task task;
  task.kind = TaskKind::tracer;
  task.campaign = campaign;
  task.campaign_hash = hash_text(moving_bed);
  task.program_version = "test";
  write_task(folder.path(), task);
  const std::string program = CUPOLA_TRACER;
  ASSERT_EQ(std::system((program + " prepare " + folder.path().string() + " > /dev/null").c_str()), 0);
  const BedMesh mesh = BedMesh::read(folder.path() / "foam" / "mesh.hdf");
  testing::write_settled_bed(folder.path() / "granular.hdf", mesh, task, 100);
  task.inputs["granular"] = {"granular.hdf", hash_file(folder.path() / "granular.hdf")};
  write_task(folder.path(), task);
  ASSERT_EQ(std::system((program + " " + folder.path().string() + " > /dev/null").c_str()), 0);

  const FieldFile result(folder.path() / "result.hdf", "tracer-result");
  const auto gas = result.cell_data("gas_temperature");
  const auto solids = result.cell_data("solids_temperature");
  // Means over each layer of cells, then a least-squares slope of the logarithm, away from removal and stock plane.
  const std::size_t layers = 80;
  std::vector<double> height(layers, 0.0), difference(layers, 0.0), gas_mean(layers, 0.0), solids_mean(layers, 0.0);
  for (std::size_t c = 0; c < mesh.cells(); ++c) {
    const auto layer = static_cast<std::size_t>(mesh.cell_centre[c][2] / 0.025);
    height[layer] = mesh.cell_centre[c][2];
    difference[layer] += (gas[c] - solids[c]) / 16;
    gas_mean[layer] += gas[c] / 16;
    solids_mean[layer] += solids[c] / 16;
  }
  const std::size_t first = 16;
  const std::size_t last = 72;
  double n = 0, sz = 0, sl = 0, szz = 0, szl = 0;
  for (std::size_t k = first; k <= last; ++k) {
    ASSERT_GT(difference[k], 0);
    const double l = std::log(difference[k]);
    n += 1;
    sz += height[k];
    sl += l;
    szz += height[k] * height[k];
    szl += height[k] * l;
  }
  const double slope = (n * szl - sz * sl) / (n * szz - sz * sz);

  const Species& pebble = campaign.species[0];
  const Gas& air = *campaign.scene.gas;
  const double mass_flux = 0.2 / 0.16;
  const double packing = expected_packing;
  const double h = heat_transfer_coefficient(mass_flux, pebble.diameter, air.viscosity, air.prandtl,
                                             gas_conductivity(air.viscosity, air.heat_capacity, air.prandtl), 1.0);
  const double exchange = h * 6 * packing / pebble.diameter;
  const double gas_flow = mass_flux * air.heat_capacity;
  const double solids_flow = campaign.descent_rate * packing * pebble.density * pebble.heat_capacity.at(293);
  const double exact = exchange * (1 / solids_flow - 1 / gas_flow);
  // The density of tracers fluctuates, and with it the exchange.
  EXPECT_NEAR(slope, exact, 0.01 * exact);
  // What one gives the other takes, between two faces, where the means of the cells meet.
  const auto at_face = [](const std::vector<double>& mean, std::size_t k) { return 0.5 * (mean[k] + mean[k + 1]); };
  const double given = gas_flow * (at_face(gas_mean, first) - at_face(gas_mean, last));
  EXPECT_NEAR(given, solids_flow * (at_face(solids_mean, first) - at_face(solids_mean, last)), 0.02 * given);
  EXPECT_LT(result.summary()["ledger"]["energy"]["residual"].get<double>(), 1e-9);
}

}  // namespace
}  // namespace cupola
