// A grain, and parcels of it, that fall through gas at rest: with the quasi-steady and with the transient gas.
#include <gtest/gtest.h>
#include <mpi.h>

#include <cmath>

#include "stage_dem/coupled_block.hpp"
#include "stage_dem/dem_gas.hpp"
#include "tests/verification/dem/gas_scene.hpp"
#include "tests/verification/dem/proof_scene.hpp"

namespace cupola::test {
namespace {

/// A gas so dense that the fall is short, and so much of it that it stays at rest.
constexpr double diameter = 8e-3, density = 2500, gas_density_of_scene = 1000, gravity = 9.81;

/// Schiller and Naumann (1933), Re < 1000, as Wen and Yu use it: 18 Re (1 + 0.15 Re^0.687) = Ar; the viscosity at which
/// a grain falls with this Reynolds number, Pa s.
double viscosity_for(double reynolds) {
  const double weight = gas_density_of_scene * density * gravity * std::pow(diameter, 3);
  return std::sqrt(weight / (18 * reynolds * (1 + 0.15 * std::pow(reynolds, 0.687))));
}

Campaign falling(DemSettings::GasModel gas, double reynolds, double coarse_graining) {
  Campaign campaign = one_species(diameter, density);
  campaign.species[0].coarse_graining = coarse_graining;
  campaign.drag = DragLaw::wen_yu;
  campaign.dem.gas = gas;
  blow_through(campaign, 1e-9, gas_density_of_scene, viscosity_for(reynolds));  // as good as at rest
  campaign.scene.geometry.profile = {{0, 0.15}, {0.9, 0.15}};
  campaign.scene.geometry.depth = 0.3;
  campaign.scene.mesh.cell = 0.3;
  campaign.charging.stock_line = 0.9;
  campaign.charging.hopper_height = 0.02;
  return campaign;
}

/// Speed it comes to rest at, over the exact one.
double fallen_speed(GasScene& scene, DemSettings::GasModel model, double reynolds, double coarse_graining) {
  const Campaign campaign = falling(model, reynolds, coarse_graining);
  const std::vector<double> temperature(scene.mesh.cells(), gas_temperature);
  const auto gas = make_dem_gas(scene.foam, scene.mesh, campaign, temperature, MPI_COMM_WORLD);
  SolidsOnMesh solids(scene.mesh, campaign, MPI_COMM_WORLD);
  const double terminal = reynolds * viscosity_for(reynolds) / (gas_density_of_scene * diameter);
  constexpr long steps = 20;
  const double block = 0.15 * terminal / gravity;
  auto engine = box_engine(campaign, block / steps);
  engine->add({new_parcel(campaign, 1, 0, {0.07, 0.06, 0.85}, {})});
  for (int blocks = 0; blocks < 50; ++blocks) {  // seven times terminal/gravity
    if (model == DemSettings::GasModel::transient) {
      advance_with_gas(*engine, solids, *gas, block / steps, steps);
    } else {
      const auto owned = engine->owned();
      solids.divide(owned);
      gas->update(solids, owned, block);
      engine->set_forces(gas->forces(solids, owned));
      engine->advance(steps);
    }
  }
  const Parcel parcel = engine->owned()[0];
  EXPECT_GT(parcel.position[2], 0.1) << "it came to the floor first";
  return -parcel.velocity[2] / terminal;
}

class TerminalVelocity : public testing::TestWithParam<DemSettings::GasModel> {};

TEST_P(TerminalVelocity, OfAGrainAndOfParcelsOfItIsSchillerAndNaumanns) {
  GasScene scene(falling(GetParam(), 1, 1));
  for (const double reynolds : {0.1, 10.0, 999.0}) {
    const double grain = fallen_speed(scene, GetParam(), reynolds, 1);
    EXPECT_NEAR(grain, 1, 3e-3) << "Re " << reynolds;
    // The drag law sees what a parcel takes of its cell, 2e-4 for n = 2, and it sets the gas in motion, eight times as
    // much as a grain does.
    EXPECT_NEAR(fallen_speed(scene, GetParam(), reynolds, 2) / grain, 1, 1e-2) << "Re " << reynolds;
  }
}

INSTANTIATE_TEST_SUITE_P(Gas, TerminalVelocity,
                         testing::Values(DemSettings::GasModel::quasi_steady, DemSettings::GasModel::transient));

}  // namespace
}  // namespace cupola::test
