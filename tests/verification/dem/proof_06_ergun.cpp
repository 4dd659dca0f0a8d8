// Pressure drop of fixed beds of grains and of parcels that stand for them.
#include <gtest/gtest.h>
#include <mpi.h>

#include <cmath>

#include "stage_dem/dem_gas.hpp"
#include "tests/verification/dem/gas_scene.hpp"
#include "tests/verification/dem/proof_scene.hpp"

namespace cupola::test {
namespace {

constexpr double parcel_diameter = 0.02, speed = 0.5, density = 1.2;

/// Ergun (1952), -dp/dz, Pa/m.
double ergun(double void_fraction, double d, double viscosity, double gas_density, double superficial) {
  const double solids = 1 - void_fraction;
  return 150 * solids * solids * viscosity * superficial / (std::pow(void_fraction, 3) * d * d) +
         1.75 * solids * gas_density * superficial * superficial / (std::pow(void_fraction, 3) * d);
}

struct Drop {
  double found = 0;     ///< Pa
  double exact = 0;     ///< Pa, Ergun's over the projected void fraction, layer by layer from the top
  double force = 0;     ///< on all parcels upwards over pressure drop x area
  double momentum = 0;  ///< residual
  double inertia = 0;   ///< Pa: momentum that leaves with the gas less what comes in, by area
};

constexpr double half_width = 0.09, depth = 0.18;

Campaign bed(DemSettings::GasModel gas, double reynolds, double coarse_graining) {
  Campaign campaign = one_species(parcel_diameter / coarse_graining, 2500);
  campaign.species[0].coarse_graining = coarse_graining;
  campaign.drag = DragLaw::ergun;
  campaign.dem.gas = gas;
  const double grain = campaign.species[0].diameter;
  const double viscosity = density * speed * grain / reynolds;
  campaign.scene.geometry.sides = Geometry::Sides::periodic;
  campaign.scene.geometry.depth = depth;
  campaign.scene.geometry.profile = {{0, half_width}, {0.36, half_width}};
  campaign.scene.mesh.cells = MeshCells{1, 1, {8}};
  campaign.scene.mesh.cell = 0.045;
  campaign.charging.stock_line = 0.4;
  blow_through(campaign, density * speed * 2 * half_width * depth, density, viscosity);
  return campaign;
}

/// Parcels that hang in the box as they were poured, and their mirror images, so that every layer of the mesh has the
/// same void fraction all over: what Ergun's law gives for a layer is then exact.
Drop drop(GasScene& scene, DemSettings::GasModel model, double reynolds, double coarse_graining) {
  const Campaign campaign = bed(model, reynolds, coarse_graining);
  const double grain = campaign.species[0].diameter;
  const double viscosity = campaign.scene.gas->viscosity;
  std::vector<Parcel> parcels = poured(campaign, 0.36);
  std::erase_if(parcels, [](const Parcel& parcel) { return parcel.position[0] < 0; });
  for (std::size_t i = 0, all = parcels.size(); i < all; ++i) {
    parcels.push_back(parcels[i]);
    parcels.back().position[0] *= -1;
  }
  for (auto& parcel : parcels) parcel.velocity = {};
  SolidsOnMesh solids(scene.mesh, campaign, MPI_COMM_WORLD);
  solids.divide(parcels);
  const auto gas = make_dem_gas(scene.foam, scene.mesh, campaign,
                                std::vector<double>(scene.mesh.cells(), gas_temperature), MPI_COMM_WORLD);
  // The steady one is there at once, the transient one after the gas has gone through the bed some times.
  const int steps = model == DemSettings::GasModel::transient ? 100 : 1;
  for (int step = 0; step < steps; ++step) gas->update(solids, parcels, 0.02);
  Drop result;
  for (const auto& force : gas->forces(solids, parcels)) result.force += force.force[2];
  result.momentum = gas->momentum_residual();
  if (model == DemSettings::GasModel::transient) {
    const auto velocity = gas->velocity();
    for (std::size_t cell = 0; cell < scene.mesh.cells(); ++cell)
      if (scene.mesh.cell_centre[cell][2] > 0.36 - 0.045)
        result.inertia = density * speed * (velocity[3 * cell + 2] - speed);
  }

  const auto& mesh = scene.mesh;
  const double outlet = campaign.scene.gas->outlet_pressure;
  double pressure = outlet;
  double mean_void = 0;
  const double height = 0.36 / 8;
  for (int layer = 7; layer >= 0; --layer) {
    double volume = 0, gas_volume = 0;
    for (std::size_t cell = 0; cell < mesh.cells(); ++cell)
      if (std::abs(mesh.cell_centre[cell][2] - (layer + 0.5) * height) < height / 4) {
        volume += mesh.cell_volume[cell];
        gas_volume += mesh.cell_volume[cell] - solids.volume()[cell];
      }
    mean_void += gas_volume / volume / 8;
    // rho U is constant, so p dp is: p^2 falls linearly.
    const double gradient = ergun(gas_volume / volume, grain, viscosity, density, speed) * outlet;
    pressure = std::sqrt(pressure * pressure + 2 * gradient * height);
  }
  result.exact = pressure - outlet;
  result.found = gas->summary()["inlets"][0]["pressure"].get<double>() - outlet;
  result.force /= (result.found - result.inertia) * 2 * half_width * depth;
  // What a cell's inertia takes of the pressure acts on the gas's share of the area only.
  result.found -= result.inertia / mean_void;
  return result;
}

class ErgunBed : public testing::TestWithParam<DemSettings::GasModel> {};

TEST_P(ErgunBed, DropsThePressureThatErgunsLawGivesForTheVoidFractionProjected) {
  GasScene scene(bed(GetParam(), 1, 1));
  for (const double coarse_graining : {1.0, 2.0, 4.0, 8.0})
    for (const double reynolds : {1.0, 10.0, 100.0, 1000.0, 10000.0}) {
      const Drop found = drop(scene, GetParam(), reynolds, coarse_graining);
      const auto which = testing::Message() << "n " << coarse_graining << ", Re " << reynolds;
      EXPECT_GT(found.exact, 0) << which;
      EXPECT_NEAR(found.found / found.exact, 1, 0.01) << which;
      EXPECT_NEAR(found.force, 1, 1e-5) << which;  // there are parcels in every cell: the bed carries the whole drop
      EXPECT_LT(found.momentum, 1e-11) << which;
    }
}

TEST(FrozenGas, KeepsItsFlowWhenTheBedChanges) {
  GasScene scene(bed(DemSettings::GasModel::frozen, 100, 2));
  for (const auto model : {DemSettings::GasModel::frozen, DemSettings::GasModel::quasi_steady}) {
    const Campaign campaign = bed(model, 100, 2);
    auto parcels = poured(campaign, 0.36);
    SolidsOnMesh solids(scene.mesh, campaign, MPI_COMM_WORLD);
    const auto gas = make_dem_gas(scene.foam, scene.mesh, campaign,
                                  std::vector<double>(scene.mesh.cells(), gas_temperature), MPI_COMM_WORLD);
    solids.divide(parcels);
    gas->update(solids, parcels, 0);
    const auto before = gas->pressure();
    parcels.resize(parcels.size() / 2);
    solids.divide(parcels);
    gas->update(solids, parcels, 10);
    EXPECT_EQ(gas->pressure() == before, model == DemSettings::GasModel::frozen);
    EXPECT_EQ(gas->forces(solids, parcels).size(), parcels.size());
  }
}

INSTANTIATE_TEST_SUITE_P(Gas, ErgunBed,
                         testing::Values(DemSettings::GasModel::quasi_steady, DemSettings::GasModel::transient));

}  // namespace
}  // namespace cupola::test
