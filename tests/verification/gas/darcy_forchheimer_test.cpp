#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "physics/closures/drag.hpp"
#include "physics/closures/gas_properties.hpp"
#include "physics/equations/face_geometry.hpp"
#include "physics/gas/bed_gas.hpp"
#include "physics/mesh/cell_locator.hpp"
#include "schemas/failure.hpp"
#include "tests/support/foam_scene.hpp"
#include "tests/support/furnaces.hpp"

namespace cupola {
namespace {

constexpr double column_height = 1.5;
constexpr double column_area = 0.6 * 0.4;

/// Drop of p^2 over a layer of the box's column: 2 R T/M r(G) G L, exact for an ideal gas.
double squared_drop(const Campaign& campaign, double void_fraction, double diameter, double temperature,
                    double height) {
  const double flux = campaign.scene.gas->inlets[0].mass_flow / column_area;
  const double resistance =
      drag_resistance(campaign.drag, void_fraction, diameter, campaign.scene.gas->viscosity, 1, flux);
  return 2 * molar_gas_constant / campaign.scene.gas->molar_mass * temperature * resistance * flux * height;
}

double inlet_pressure(const DarcyForchheimer& flow) { return flow.inlets()[0].state.static_pressure; }

class EveryDragLaw : public ::testing::TestWithParam<DragLaw> {};

TEST_P(EveryDragLaw, CompressibleColumnIsExact) {
  Campaign campaign = furnaces::box();
  campaign.drag = GetParam();
  FoamScene scene(campaign);
  DarcyForchheimer flow(scene.foam, scene.mesh, campaign);
  const auto result =
      flow.solve(uniform_bed(scene.mesh, 0.42, 0.015), std::vector<double>(scene.mesh.cells(), 900), 1e-9, 50);
  const double outlet = campaign.scene.gas->outlet_pressure;
  const double exact = std::sqrt(outlet * outlet + squared_drop(campaign, 0.42, 0.015, 900, column_height));
  EXPECT_NEAR(inlet_pressure(flow) - outlet, exact - outlet, 1e-8 * (exact - outlet));
  EXPECT_LE(result.iterations, 8);
  EXPECT_LT(result.mass_residual, 5e-11);
}

INSTANTIATE_TEST_SUITE_P(DragLaws, EveryDragLaw,
                         ::testing::Values(DragLaw::ergun, DragLaw::gidaspow, DragLaw::beetstra),
                         [](const auto& law) { return std::string(drag_law_name(law.param)); });

TEST(DarcyForchheimer, ErgunBedOfTheReferenceCases) {
  // Grains of 1 mm, void fraction 0.451335, 15.6 mm high, gas of 10 kg/m3 and 1.5e-4 m2/s.
  const double density = 10, temperature = 293;
  for (const auto& [speed, drop] : {std::pair{2e-3, 22.992}, {10e-3, 115.09}, {20e-3, 230.51}}) {
    Campaign campaign = furnaces::box();
    campaign.drag = DragLaw::ergun;
    campaign.scene.geometry.depth = 0.01;
    campaign.scene.geometry.profile = {{0, 0.005}, {0.0156, 0.005}};
    campaign.scene.mesh.cell = 0.0026;
    campaign.charging.stock_line = 0.02;
    auto& gas = *campaign.scene.gas;
    gas.viscosity = 1.5e-4 * density;
    gas.inlets[0].mass_flow = density * speed * 1e-4;
    // The density is that of the column's middle.
    gas.outlet_pressure = density * molar_gas_constant * temperature / gas.molar_mass - drop / 2;
    FoamScene scene(campaign);
    DarcyForchheimer flow(scene.foam, scene.mesh, campaign);
    flow.solve(uniform_bed(scene.mesh, 0.451335, 1e-3), std::vector<double>(scene.mesh.cells(), temperature), 1e-9, 20);
    EXPECT_NEAR(inlet_pressure(flow) - gas.outlet_pressure, drop, 5e-5 * drop);
  }
}

TEST(DarcyForchheimer, HotAndColdLayersOfTwoGrainsAreExact) {
  const Campaign campaign = furnaces::box();
  FoamScene scene(campaign);
  auto bed = uniform_bed(scene.mesh, 0.42, 0.044);
  std::vector<double> temperature(scene.mesh.cells(), 2000);
  for (std::size_t cell = 0; cell < scene.mesh.cells(); ++cell) {
    const double z = scene.mesh.cell_centre[cell][2];
    if (z > 0.5) temperature[cell] = 400;
    if (z > 1) {
      bed.grain_diameter[cell] = 0.01;
      bed.void_fraction[cell] = 0.38;
    }
  }
  DarcyForchheimer flow(scene.foam, scene.mesh, campaign);
  flow.solve(bed, temperature, 1e-9, 50);
  const double outlet = campaign.scene.gas->outlet_pressure;
  const double exact =
      std::sqrt(outlet * outlet + squared_drop(campaign, 0.42, 0.044, 2000, 0.5) +
                squared_drop(campaign, 0.42, 0.044, 400, 0.5) + squared_drop(campaign, 0.38, 0.01, 400, 0.5));
  EXPECT_NEAR(inlet_pressure(flow) - outlet, exact - outlet, 1e-8 * (exact - outlet));
  const double flux = campaign.scene.gas->inlets[0].mass_flow / column_area;
  for (const auto& g : flow.mass_flux()) {
    EXPECT_NEAR(g[2], flux, 1e-9 * flux);
    EXPECT_NEAR(g[0], 0, 1e-9 * flux);
  }
}

TEST(DarcyForchheimer, FlowFansOutBetweenSlantedWalls) {
  // Half width 0.3 to 0.6 m over 1.5 m: away from the ends the gas flows radially from the walls' common line 1.5 m
  // below, so that psi falls along circles' radii, and mid-height it is larger at x = 0 than at x by r G x^2/(2 R).
  Campaign campaign = furnaces::box();
  campaign.scene.geometry.kind = Geometry::Kind::slot;
  campaign.scene.geometry.profile = {{0, 0.3}, {1.5, 0.6}};
  campaign.scene.mesh.cell = 0.05;
  campaign.drag = DragLaw::ergun;
  campaign.scene.gas->viscosity = 1;  // no inertial part: linear
  campaign.scene.gas->inlets[0].mass_flow = 1e-4;
  FoamScene scene(campaign);
  DarcyForchheimer flow(scene.foam, scene.mesh, campaign);
  flow.solve(uniform_bed(scene.mesh, 0.42, 0.01), std::vector<double>(scene.mesh.cells(), 900), 1e-10, 100);
  const double resistance =
      molar_gas_constant / campaign.scene.gas->molar_mass * 900 * drag_resistance(DragLaw::ergun, 0.42, 0.01, 1, 1, 0);
  const auto& psi = flow.warm_start().squared_pressure;
  const CellLocator locator(scene.mesh);
  const auto middle = locator.find({0.01, 0.01, 0.76});
  const auto side = locator.find({0.42, 0.01, 0.76});
  const Vector3 &near = scene.mesh.cell_centre[middle], &far = scene.mesh.cell_centre[side];
  const double radius = 1.5 + near[2];
  const double expected =
      resistance * flow.mass_flux()[middle][2] * (far[0] * far[0] - near[0] * near[0]) / (2 * radius);
  EXPECT_NEAR(psi[middle] - psi[side], expected, 0.05 * expected);
  EXPECT_NEAR(flow.mass_flux()[side][0] / flow.mass_flux()[side][2], far[0] / radius, 0.02 * far[0] / radius);
}

TEST(DarcyForchheimer, AnEmptyFreeboardCostsNoPressure) {
  const Campaign campaign = furnaces::box();
  FoamScene scene(campaign);
  auto bed = uniform_bed(scene.mesh, 0.42, 0.015);
  for (std::size_t cell = 0; cell < scene.mesh.cells(); ++cell) {
    if (scene.mesh.cell_centre[cell][2] > 1) bed.void_fraction[cell] = 1;
  }
  DarcyForchheimer flow(scene.foam, scene.mesh, campaign);
  flow.solve(bed, std::vector<double>(scene.mesh.cells(), 900), 1e-9, 50);
  const double outlet = campaign.scene.gas->outlet_pressure;
  const double exact = std::sqrt(outlet * outlet + squared_drop(campaign, 0.42, 0.015, 900, 1));
  EXPECT_NEAR(inlet_pressure(flow) - outlet, exact - outlet, 1e-4 * (exact - outlet));
}

/// The shaft with raceways, layers of coke and ore, a freeboard and a hot zone: everything that makes the equation
/// hard.
BedState layered_bed(const BedMesh& mesh) {
  auto bed = uniform_bed(mesh, 0.42, 0.044);
  for (std::size_t cell = 0; cell < mesh.cells(); ++cell) {
    const Vector3& c = mesh.cell_centre[cell];
    if (c[2] > 2 && std::fmod(c[2], 0.8) < 0.35) {
      bed.grain_diameter[cell] = 0.015;
      bed.void_fraction[cell] = 0.4;
    }
    if (std::abs(c[0]) > 0.9 && std::abs(c[2] - 0.06) < 0.3) bed.void_fraction[cell] = 0.75;
    if (c[2] > 6.1) bed.void_fraction[cell] = 1;
  }
  return bed;
}

std::vector<double> shaft_temperature(const BedMesh& mesh) {
  std::vector<double> temperature(mesh.cells());
  for (std::size_t cell = 0; cell < mesh.cells(); ++cell) {
    const Vector3& c = mesh.cell_centre[cell];
    temperature[cell] = 400 + 2000 / (1 + std::exp(2 * (c[2] + std::abs(c[0]) - 2.5)));
  }
  return temperature;
}

class Shaft : public ::testing::Test {
 protected:
  Campaign campaign = furnaces::shaft();
  FoamScene scene{campaign};
  BedState bed = layered_bed(scene.mesh);
  std::vector<double> temperature = shaft_temperature(scene.mesh);
  DarcyForchheimer flow{scene.foam, scene.mesh, campaign};
};

TEST_F(Shaft, ConvergesAndConservesMass) {
  const auto result = flow.solve(bed, temperature, 1e-8, 100);
  RecordProperty("iterations", result.iterations);
  RecordProperty("cycles", result.cycles);
  EXPECT_LT(result.change, 1e-8);
  EXPECT_LT(result.mass_residual, 1e-10);
  double top = 0;
  const auto* outlet = scene.mesh.find_patch("outlet");
  for (auto face = outlet->first_face; face < outlet->first_face + outlet->faces; ++face)
    top += flow.face_mass_flux()[face];
  EXPECT_NEAR(top, 2.8, 1e-9);
  for (const auto& inlet : flow.inlets()) {
    EXPECT_GT(inlet.state.mach_number, 0.05);
    EXPECT_LT(inlet.state.mach_number, 0.5);
    EXPECT_LT(inlet.smallest_opening, 0.0625);
  }
  EXPECT_GT(flow.inertia_over_drag_largest(), 0);
  RecordProperty("inertia_over_drag", std::to_string(flow.inertia_over_drag_largest()));
}

TEST_F(Shaft, IsSymmetric) {
  flow.solve(bed, temperature, 1e-9, 100);
  const auto inlets = flow.inlets();
  EXPECT_NEAR(inlets[0].state.static_pressure, inlets[1].state.static_pressure, 1e-8 * inlets[0].state.static_pressure);
}

TEST_F(Shaft, SumOfPressureGradientsIsTheSurfaceIntegral) {
  flow.solve(bed, temperature, 1e-6, 100);
  Vector3 sum{0, 0, 0};
  double magnitude = 0;
  for (std::size_t cell = 0; cell < scene.mesh.cells(); ++cell) {
    for (std::size_t axis = 0; axis < 3; ++axis) {
      sum[axis] += scene.mesh.cell_volume[cell] * flow.pressure_gradient()[cell][axis];
      magnitude += std::abs(scene.mesh.cell_volume[cell] * flow.pressure_gradient()[cell][axis]);
    }
  }
  // The left half against the right, front against back: nothing is left across.
  EXPECT_NEAR(sum[0], 0, 1e-6 * magnitude);
  EXPECT_NEAR(sum[1], 0, 1e-10 * magnitude);
  EXPECT_LT(sum[2], 0);
}

TEST_F(Shaft, GoesOnFromItsWarmStartBitByBit) {
  flow.solve(bed, temperature, 1e-3, 100);
  DarcyForchheimer again(scene.foam, scene.mesh, campaign);
  again.restore(flow.warm_start(), flow.face_pressure(), flow.inertia_over_drag());
  for (double& t : temperature) t *= 1.02;
  flow.solve(bed, temperature, 1e-3, 1);
  again.solve(bed, temperature, 1e-3, 1);
  EXPECT_EQ(flow.pressure(), again.pressure());
  EXPECT_EQ(flow.face_mass_flux(), again.face_mass_flux());
}

TEST_F(Shaft, OneWarmIterationFollowsASmallChange) {
  flow.solve(bed, temperature, 1e-8, 100);
  for (std::size_t cell = 0; cell < scene.mesh.cells(); ++cell)
    temperature[cell] += 20 * std::sin(scene.mesh.cell_centre[cell][2]);
  DarcyForchheimer exact(scene.foam, scene.mesh, campaign);
  exact.solve(bed, temperature, 1e-10, 100);
  flow.solve(bed, temperature, 1e-8, 1);
  double wrong = 0, all = 0;
  for (std::size_t face = 0; face < scene.mesh.faces(); ++face) {
    wrong += std::pow(flow.face_mass_flux()[face] - exact.face_mass_flux()[face], 2);
    all += std::pow(exact.face_mass_flux()[face], 2);
  }
  EXPECT_LT(std::sqrt(wrong / all), 1e-3);
}

TEST_F(Shaft, ACellWithoutGasIsNamed) {
  for (const double wrong : {0.0, std::numeric_limits<double>::quiet_NaN()}) {
    bed.void_fraction[17] = wrong;
    try {
      flow.solve(bed, temperature, 1e-3, 5);
      FAIL();
    } catch (const Failure& failure) {
      EXPECT_EQ(failure.code(), ExitCode::diverged);
      EXPECT_EQ(failure.where().at("cell"), "17");
    }
  }
}

TEST_F(Shaft, NoSolidsLeftIsAFailure) {
  bed.void_fraction.assign(scene.mesh.cells(), 1);
  EXPECT_THROW(flow.solve(bed, temperature, 1e-3, 5), Failure);
}

}  // namespace
}  // namespace cupola
