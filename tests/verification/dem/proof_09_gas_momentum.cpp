// What the gas gives the parcels it has lost itself: over a thousand steps, on any number of ranks.
#include <gtest/gtest.h>
#include <mpi.h>

#include <cmath>

#include "stage_dem/parcels.hpp"
#include "stage_dem/transient_coupling.hpp"
#include "tests/verification/dem/gas_scene.hpp"
#include "tests/verification/dem/proof_scene.hpp"

namespace cupola::test {
namespace {

constexpr double engine_step = 2e-5;
constexpr long engine_steps = 5;  // a step of the gas

Campaign blown() {
  Campaign campaign = one_species(0.04, 40);
  campaign.drag = DragLaw::gidaspow;
  campaign.dem.gas = DemSettings::GasModel::transient;
  campaign.scene.mesh.cell = 0.15;
  campaign.charging.stock_line = 1.1;
  blow_through(campaign, 1.2 * 3 * 0.6, 1.2, 1.8e-5);  // 3 m/s
  return campaign;
}

/// Parcels in free flight in a part of the box, so that the gas finds its way around them: no contact takes or gives
/// momentum.
std::vector<Parcel> cloud(const Campaign& campaign) {
  std::vector<Parcel> parcels;
  for (double z = 0.25; z < 0.76; z += 0.05)
    for (double x = -0.3; x < 0.21; x += 0.05)
      for (double y = -0.2; y < 0.21; y += 0.05) {
        const auto id = static_cast<std::int64_t>(parcels.size()) + 1;
        parcels.push_back(new_parcel(campaign, id, 0, {x, y, z}, {}));
      }
  return parcels;
}

TEST(GasMomentum, GivenToTheParcelsOverAThousandStepsIsWhatTheGasLost) {
  const Campaign campaign = blown();
  GasScene scene(campaign);
  const auto& mesh = scene.mesh;
  TransientCoupling gas(scene.foam, mesh, campaign, std::vector<double>(mesh.cells(), gas_temperature), MPI_COMM_WORLD);
  SolidsOnMesh solids(mesh, campaign, MPI_COMM_WORLD);
  auto engine = box_engine(campaign, engine_step);
  const auto parcels = cloud(campaign);
  engine->add(parcels);
  const double weight = 9.81 * parcels[0].mass * static_cast<double>(parcels.size());
  // Impulses, N s: of the gas by its own balance, of pressure on the solids, and how large they are without their
  // signs.
  Vector3 lost{}, pressed{};
  double size = 0;
  const double seconds = engine_step * engine_steps;
  engine->advance(1000 * engine_steps, [&] {
    const auto owned = engine->owned();
    solids.divide(owned);
    gas.update(solids, owned, seconds);
    engine->set_forces(gas.forces(solids, owned));
    const auto& flow = gas.flow();
    for (std::size_t k = 0; k < 3; ++k) lost[k] -= seconds * flow.force_of_solids()[k];
    for (std::size_t cell = 0; cell < mesh.cells(); ++cell)
      for (std::size_t k = 0; k < 3; ++k) {
        pressed[k] -= seconds * solids.volume()[cell] * flow.pressure_gradient()[cell][k];
        size += seconds * mesh.cell_volume[cell] * std::abs(flow.drag()[cell][k]);
      }
    return engine_steps;
  });
  Vector3 found{};
  for (const auto& parcel : everyone(*engine))
    for (std::size_t k = 0; k < 3; ++k) found[k] += parcel.mass * parcel.velocity[k];
  found[2] += weight * seconds * 1000;
  for (std::size_t k = 0; k < 3; ++k) EXPECT_NEAR((found[k] - pressed[k] - lost[k]) / size, 0, 1e-10) << k;
  EXPECT_GT(lost[2], 0.3 * size);  // the gas does something
  EXPECT_LT(gas.summary()["mass_residual"].get<double>(), 1e-9);
}

/// The cells' gas is what came in less what went out, whatever the parcels displaced.
TEST(GasMomentum, ComesWithMassThatIsConserved) {
  const Campaign campaign = blown();
  GasScene scene(campaign);
  const auto& mesh = scene.mesh;
  const std::vector<double> temperature(mesh.cells(), gas_temperature);
  TransientFlow flow(scene.foam, mesh, campaign, temperature);
  const auto parcels = cloud(campaign);
  SolidsOnMesh solids(mesh, campaign, MPI_COMM_WORLD);
  const auto inside = [&] {
    double mass = 0;
    const auto memory = flow.memory();
    for (std::size_t cell = 0; cell < mesh.cells(); ++cell)
      mass += mesh.cell_volume[cell] * memory.void_fraction[cell] * memory.gas_density[cell];
    return mass;
  };
  auto moved = parcels;
  double first = 0, through = 0, blown_in = 0;
  for (int step = 0; step < 200; ++step) {
    for (auto& parcel : moved) parcel.position[2] += 2e-4;
    solids.divide(moved);
    const BedState bed = bed_state(mesh, campaign, solids.species_volume());
    if (step == 0) {
      flow.take_void_fraction(bed.void_fraction);
      first = inside();
    }
    const std::vector<Vector3> velocity(mesh.cells(), Vector3{0, 0, 0.2});
    flow.step({bed, solids.volume(), velocity}, temperature, 1e-3);
    for (std::size_t face = mesh.internal_faces(); face < mesh.faces(); ++face) {
      if (mesh.face_neighbour[face] >= 0) continue;
      through += 1e-3 * flow.face_mass_flux()[face];
      blown_in += 1e-3 * std::max(0.0, -flow.face_mass_flux()[face]);
    }
  }
  EXPECT_NEAR((inside() - first + through) / blown_in, 0, 1e-9);
}

}  // namespace
}  // namespace cupola::test
