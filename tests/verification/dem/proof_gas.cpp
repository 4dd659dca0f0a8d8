// The gas's forces on parcels: terminal velocity, pressure drop of fixed beds, momentum handed over.
#include <gtest/gtest.h>

#include <cmath>
#include <numeric>

#include "physics/closures/drag.hpp"
#include "physics/closures/gas_properties.hpp"
#include "stage_dem/gas_coupling.hpp"
#include "tests/support/foam_scene.hpp"
#include "tests/support/furnaces.hpp"
#include "tests/verification/dem/proof_scene.hpp"

namespace cupola::test {
namespace {

constexpr double temperature = 293;

/// An upright column of one cell in depth and two across, blown through from below.
Campaign column(double half_width, double depth, double height, int layers) {
  Campaign campaign = one_species(0.01, 2500);
  campaign.scene = furnaces::box().scene;
  campaign.scene.geometry.depth = depth;
  campaign.scene.geometry.sides = Geometry::Sides::walls;
  campaign.scene.geometry.profile = {{0, half_width}, {height, half_width}};
  campaign.scene.mesh.cells = MeshCells{1, 1, {layers}};
  campaign.scene.mesh.cell = height / layers;
  campaign.scene.gas->inlets[0].total_temperature = temperature;
  campaign.charging.stock_line = height;
  return campaign;
}

/// Gas of a density at the outlet.
void set_density(Gas& gas, double density) {
  gas.molar_mass = density * molar_gas_constant * temperature / gas.outlet_pressure;
  gas.heat_capacity = 3.5 * molar_gas_constant / gas.molar_mass;
}

TEST(TerminalVelocity, OfAGrainAndOfItsParcelAreThatOfTheDragCurve) {
  // Where the drag coefficient C_D = 24/Re (1 + 0.15 Re^0.687) carries the weight (without buoyancy, which the gas
  // model leaves out): mu follows from the Reynolds number wanted.
  constexpr double diameter = 0.01, solid = 2500, gas_density = 100, gravity = 9.81;
  Campaign campaign = column(0.2, 0.4, 6, 15);
  campaign.drag = DragLaw::wen_yu;
  FoamScene scene(campaign);
  for (const double reynolds : {0.1, 1.0, 10.0, 100.0, 999.0}) {
    const double coefficient = 24 / reynolds * (1 + 0.15 * std::pow(reynolds, 0.687));
    const double exact = std::sqrt(4.0 / 3 * gravity * diameter * solid / (coefficient * gas_density));
    for (const double n : {1.0, 2.0, 4.0}) {
      campaign.species[0].coarse_graining = n;
      auto& gas = *campaign.scene.gas;
      set_density(gas, gas_density);
      gas.viscosity = gas_density * exact * diameter / reynolds;
      gas.inlets[0].mass_flow = 1e-9;
      SolidsOnMesh solids(scene.mesh, campaign, MPI_COMM_WORLD);
      GasCoupling coupling(scene.foam, scene.mesh, campaign, std::vector<double>(scene.mesh.cells(), temperature));
      const double block = 0.2 * exact / gravity;
      auto engine = box_engine(campaign, block / 20);
      engine->add({new_parcel(campaign, 1, 0, {0.1, 0, 5.5}, {})});
      for (int i = 0; i < 60 && everyone(*engine)[0].position[2] > 0.5; ++i) {
        const auto owned = engine->owned();
        solids.divide(owned);
        coupling.update(solids, block);
        engine->set_forces(coupling.forces(solids, owned, MPI_COMM_WORLD));
        engine->advance(20);
      }
      EXPECT_NEAR(-everyone(*engine)[0].velocity[2] / exact, 1, 0.01) << "Re " << reynolds << " n " << n;
    }
  }
}

/// A bed of parcels on a lattice with gaps of changing height between its layers, mirror-symmetric in x: the void
/// fraction changes along the height only.
std::vector<Parcel> layered_lattice(const Campaign& campaign) {
  const double d = campaign.species[0].parcel_diameter();
  const double w = campaign.half_width(0), depth = campaign.scene.geometry.depth;
  std::vector<Parcel> parcels;
  double z = d / 2;
  for (int layer = 0; z + d / 2 <= campaign.top(); ++layer) {
    for (double y = -depth / 2 + d / 2; y < depth / 2; y += d)
      for (double x = -w + d / 2; x < w; x += d)
        parcels.push_back(new_parcel(campaign, static_cast<std::int64_t>(parcels.size()) + 1, 0, {x, y, z}, {}));
    z += d * (1 + 0.1 * (layer % 3));
  }
  return parcels;
}

TEST(FixedBed, PressureDropIsErgunsOverTheProjectedVoidFraction) {
  // 20 mm grains as they are and as parcels of 2, 4 and 8, in cells of 71 mm: a parcel is 0.3 to 2.2 cells high.
  constexpr double diameter = 0.02;
  Campaign campaign = column(0.16, 0.32, 0.64, 9);
  campaign.drag = DragLaw::ergun;
  campaign.species[0].diameter = diameter;
  campaign.scene.gas->viscosity = 2e-5;
  FoamScene scene(campaign);
  for (const auto model : {DemSettings::VoidFraction::divided, DemSettings::VoidFraction::smoothed}) {
    for (const double n : {1.0, 2.0, 4.0, 8.0}) {
      campaign.dem.void_fraction = model;
      campaign.dem.smoothing_length = 0.16;
      campaign.species[0].coarse_graining = n;
      for (const double reynolds : {1.0, 10.0, 100.0, 1e3, 1e4}) {
        const double area = 2 * 0.16 * 0.32;
        const double flux = reynolds * campaign.scene.gas->viscosity / diameter;
        campaign.scene.gas->inlets[0].mass_flow = flux * area;
        const auto parcels = layered_lattice(campaign);
        SolidsOnMesh solids(scene.mesh, campaign, MPI_COMM_SELF);
        solids.divide(parcels);
        GasCoupling coupling(scene.foam, scene.mesh, campaign, std::vector<double>(scene.mesh.cells(), temperature));
        coupling.update(solids, 0, true);

        double squared = 0;  // p^2 at the inlet less p^2 at the outlet
        for (std::size_t cell = 0; cell < scene.mesh.cells(); ++cell) {
          const double void_fraction = 1 - solids.volume()[cell] / scene.mesh.cell_volume[cell];
          const double solid = 1 - void_fraction;
          const double gradient = 150 * 2e-5 * solid * solid / std::pow(void_fraction, 3) / std::pow(diameter, 2) +
                                  1.75 * flux * solid / std::pow(void_fraction, 3) / diameter;
          squared += 2 * molar_gas_constant / campaign.scene.gas->molar_mass * temperature * gradient * flux *
                     scene.mesh.cell_volume[cell] / area;
        }
        const double outlet = campaign.scene.gas->outlet_pressure;
        const double ergun = squared / (std::sqrt(outlet * outlet + squared) + outlet);
        const double found = coupling.summary()["inlets"][0]["pressure"].get<double>() - outlet;
        EXPECT_NEAR(found / ergun, 1, 0.01) << "n " << n << " Re " << reynolds;

        double carried = 0;
        for (const auto& force : coupling.forces(solids, parcels, MPI_COMM_SELF)) carried += force.force[2];
        EXPECT_NEAR(carried / (found * area), 1, 1e-6) << "n " << n << " Re " << reynolds;
        EXPECT_LT(coupling.momentum_residual(), 1e-12);
      }
    }
  }
}

TEST(Momentum, WhatTheParcelsGainIsWhatThePressureGives) {
  // 1,000 steps in 100 blocks of parcels in free flight through a column, solids in every cell: the impulse of weight
  // and of the pressure on the column's ends, without the implicit part.
  Campaign campaign = column(0.2, 0.4, 1.2, 3);
  campaign.drag = DragLaw::gidaspow;
  campaign.species[0].diameter = 0.04;
  campaign.scene.gas->inlets[0].mass_flow = 0.3;
  FoamScene scene(campaign);
  for (const auto model : {DemSettings::VoidFraction::divided, DemSettings::VoidFraction::smoothed}) {
    campaign.dem.void_fraction = model;
    campaign.dem.smoothing_length = 0.2;
    SolidsOnMesh solids(scene.mesh, campaign, MPI_COMM_WORLD);
    GasCoupling coupling(scene.foam, scene.mesh, campaign, std::vector<double>(scene.mesh.cells(), temperature));
    constexpr double step = 2e-5;
    auto engine = box_engine(campaign, step);
    std::vector<Parcel> parcels;
    for (double z = 0.1; z < 1.15; z += 0.1)
      for (double x = -0.15; x < 0.2; x += 0.1)
        for (double y = -0.15; y < 0.2; y += 0.1)
          parcels.push_back(new_parcel(campaign, static_cast<std::int64_t>(parcels.size()) + 1, 0, {x, y, z},
                                       {0.1 * std::sin(7 * z), 0.1 * std::cos(5 * x), 0}));
    engine->add(parcels);
    const auto momentum = [&] {
      Vector3 sum{};
      for (const auto& parcel : everyone(*engine))
        for (std::size_t k = 0; k < 3; ++k) sum[k] += parcel.mass * parcel.velocity[k];
      return sum;
    };
    const Vector3 before = momentum();
    double weight = 0;
    for (const auto& parcel : parcels) weight += 9.81 * parcel.mass;
    Vector3 impulse{0, 0, -weight * 1000 * step};
    double pressure_impulse = 0;
    double size = 0;
    for (int block = 0; block < 100; ++block) {
      const auto owned = engine->owned();
      solids.divide(owned);
      coupling.update(solids, 0, true);
      auto forces = coupling.forces(solids, owned, MPI_COMM_WORLD);
      for (auto& force : forces) {
        force.damping = 0;
        for (std::size_t k = 0; k < 3; ++k) impulse[k] += force.force[k] * 10 * step;
        size += std::hypot(force.force[0], force.force[1], force.force[2]) * 10 * step;
      }
      const double inlet = coupling.summary()["inlets"][0]["pressure"].get<double>();
      pressure_impulse += (inlet - campaign.scene.gas->outlet_pressure) * 0.16 * 10 * step;
      engine->set_forces(forces);
      engine->advance(10);
    }
    const Vector3 after = momentum();
    for (std::size_t k = 0; k < 3; ++k) EXPECT_NEAR((after[k] - before[k] - impulse[k]) / size, 0, 1e-10) << k;
    EXPECT_NEAR((impulse[2] + weight * 1000 * step) / pressure_impulse, 1, 1e-8);
    EXPECT_LT(coupling.momentum_residual(), 1e-12);
  }
}

}  // namespace
}  // namespace cupola::test
