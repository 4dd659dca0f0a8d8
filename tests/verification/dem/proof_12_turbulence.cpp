// Turbulence of the transient gas: OpenFOAM's models on our flow do what they do in theory.
#include <fmt/format.h>
#include <gtest/gtest.h>
#include <mpi.h>

#include <cmath>

#include "physics/mesh/foam_turbulence.hpp"
#include "physics/turbulence/turbulence.hpp"
#include "stage_dem/parcels.hpp"
#include "stage_dem/solids_on_mesh.hpp"
#include "tests/verification/dem/gas_scene.hpp"
#include "tests/verification/dem/proof_scene.hpp"

namespace cupola::test {
namespace {

using Model = TransientGas::Turbulence;

constexpr double half_width = 0.05, depth = 0.1, height = 1.4;  // m
constexpr double density = 1.2, viscosity = 1.8e-5, speed = 10;

Campaign column(Model model) {
  Campaign campaign = one_species(0.04, 800);
  campaign.drag = DragLaw::gidaspow;
  campaign.dem.gas = DemSettings::GasModel::transient;
  campaign.dem.transient.turbulence = model;
  campaign.scene.geometry.sides = Geometry::Sides::periodic;
  campaign.scene.geometry.depth = depth;
  campaign.scene.geometry.profile = {{0, half_width}, {height, half_width}};
  campaign.scene.mesh.cell = 0.01;
  campaign.scene.mesh.cells = MeshCells{1, 1, {140}};
  campaign.charging.stock_line = height;
  blow_through(campaign, density * speed * 2 * half_width * depth, density, viscosity);
  return campaign;
}

struct Gases {
  std::vector<double> k, pressure, above;  ///< of each cell; its height
  double residual = 0;
  double largest_ratio = 0;  ///< eddy viscosity over viscosity
};

/// The gas after some seconds in a bed that does not move.
Gases blow(const Campaign& campaign, const std::vector<Parcel>& parcels, double seconds, double courant = 0.5) {
  GasScene scene(campaign);
  const std::vector<double> temperature(scene.mesh.cells(), gas_temperature);
  SolidsOnMesh solids(scene.mesh, campaign, MPI_COMM_WORLD);
  solids.divide(parcels);
  const BedState bed = bed_state(scene.mesh, campaign, solids.species_volume());
  const std::vector<Vector3> at_rest(scene.mesh.cells(), Vector3{});
  TransientFlow flow(scene.foam, scene.mesh, campaign, temperature);
  flow.take_void_fraction(bed.void_fraction);
  const auto turbulence = make_turbulence(scene.foam, scene.mesh, campaign);
  double step = 1e-4;
  for (double time = 0; time < seconds; time += step) {
    flow.step({bed, solids.volume(), at_rest}, temperature, step);
    if (turbulence) {
      turbulence->step(flow, temperature, step);
      flow.set_eddy_viscosity(turbulence->eddy_viscosity());
    }
    step = std::min(1.5 * step, courant * flow.crossing_time());
  }
  Gases found;
  found.residual = flow.mass_residual();
  found.pressure = flow.pressure();
  for (const auto& centre : scene.mesh.cell_centre) found.above.push_back(centre[2]);
  if (!turbulence) return found;
  found.k = turbulence->k();
  for (const double eddies : turbulence->eddy_viscosity())
    found.largest_ratio = std::max(found.largest_ratio, eddies / viscosity);
  return found;
}

/// Behind a grid nothing makes turbulence: U dk/dz = -epsilon, U d epsilon/dz = -C2 epsilon^2/k, so that
/// k = k0 (1 + (C2 - 1) epsilon0 z/(k0 U))^(-1/(C2 - 1)).
class GridTurbulence : public testing::TestWithParam<std::pair<Model, double>> {};

TEST_P(GridTurbulence, DecaysByThePowerOfItsModel) {
  const auto& [model, c2] = GetParam();
  Campaign campaign = column(model);
  campaign.scene.gas->viscosity = 1e-8;  // the realizable model's destruction has k + sqrt(nu epsilon) for k
  const double k0 = 1.5 * std::pow(inlet_intensity * speed, 2);
  const double epsilon0 =
      std::pow(0.09, 0.75) * std::pow(k0, 1.5) / inlet_mixing_length(campaign, campaign.scene.gas->inlets[0]);
  const Gases found = blow(campaign, {}, 0.35);  // two and a half passages
  double worst = 0, last = 1;
  for (std::size_t cell = 0; cell < found.k.size(); ++cell) {
    const double exact = k0 * std::pow(1 + (c2 - 1) * epsilon0 * found.above[cell] / (k0 * speed), -1 / (c2 - 1));
    worst = std::max(worst, std::abs(found.k[cell] / exact - 1));
    last = std::min(last, found.k[cell] / k0);
  }
  fmt::print("C2 = {}: k falls to {:.3f}, off by at most {:.4f}\n", c2, last, worst);
  EXPECT_LT(last, 0.4);
  EXPECT_LT(worst, 0.01);
}

INSTANTIATE_TEST_SUITE_P(Models, GridTurbulence,
                         testing::Values(std::pair{Model::k_epsilon, 1.92}, std::pair{Model::rng_k_epsilon, 1.68},
                                         std::pair{Model::realizable_k_epsilon, 1.9}));

/// Through a packed bed the drag is all that counts.
TEST(TurbulenceInABed, LeavesThePressureDropToTheDrag) {
  const auto bed_of = [](Model model) {
    Campaign campaign = column(model);
    campaign.scene.mesh.cells = MeshCells{1, 1, {35}};
    campaign.scene.gas->inlets[0].mass_flow /= 10;
    std::vector<Parcel> parcels;
    for (double z = 0.42; z < 1; z += 0.04)
      for (const double x : {-0.025, 0.025})
        for (const double y : {-0.025, 0.025})
          parcels.push_back(new_parcel(campaign, static_cast<std::int64_t>(parcels.size()) + 1, 0, {x, y, z}, {}));
    return blow(campaign, parcels, 3);
  };
  const Gases laminar = bed_of(Model::laminar), turbulent = bed_of(Model::k_epsilon);
  const double drop = laminar.pressure.front() - laminar.pressure.back();
  fmt::print("drop {:.3f} Pa, with k-epsilon {:.3f}; eddy viscosity up to {:.0f} times the gas's\n", drop,
             turbulent.pressure.front() - turbulent.pressure.back(), turbulent.largest_ratio);
  EXPECT_GT(turbulent.largest_ratio, 1) << "it is on";
  const auto k_at = [&](double z) {
    for (std::size_t cell = 0; cell < turbulent.k.size(); ++cell)
      if (std::abs(turbulent.above[cell] - z) < 0.021) return turbulent.k[cell];
    return std::nan("");
  };
  // At about 54/s for a third of a second.
  EXPECT_LT(k_at(0.98), 1e-3 * k_at(0.3)) << "grains damp it";
  EXPECT_NEAR((turbulent.pressure.front() - turbulent.pressure.back()) / drop, 1, 1e-3);
}

}  // namespace
}  // namespace cupola::test
