// Fluidisation curve of seed 004, case A (Hilton and Cleary 2012): 4 mm grains of 1000 kg/m3 in air, linear springs,
// friction 0.1, restitution 0.5; as grains and as representative particles of 6 mm.
#include <fmt/format.h>
#include <gtest/gtest.h>
#include <mpi.h>

#include <chrono>
#include <cmath>

#include "physics/plan/dem_time_step.hpp"
#include "stage_dem/coupled_block.hpp"
#include "stage_dem/dem_gas.hpp"
#include "stage_dem/parcels.hpp"
#include "tests/verification/dem/gas_scene.hpp"
#include "tests/verification/dem/proof_scene.hpp"

namespace cupola::test {
namespace {

constexpr double grain = 4e-3, grain_density = 1000, gas_density_of_scene = 1.2, viscosity = 1.8e-5, gravity = 9.81;

struct Column {
  double half_width, depth, height;  ///< m
  double bed;                        ///< m, about, when settled
  double stiffness;                  ///< N/m
  double settle, average;            ///< s, at each speed of the gas
  std::vector<double> speeds;        ///< m/s, superficial, falling: from a fluidised bed down to a fixed one
};

struct Curve {
  std::vector<double> drop;  ///< of the pressure over weight/area, at each speed
  double void_fraction = 0;  ///< in the middle of the bed at the lowest speed
  double wall_seconds = 0;
  double parcels = 0;
};

Campaign case_a(const Column& column, double coarse_graining, double speed) {
  Campaign campaign = one_species(grain, grain_density);
  campaign.species[0].coarse_graining = coarse_graining;
  campaign.contacts.model = Contacts::Model::linear_spring;
  campaign.contacts.stiffness = column.stiffness;
  campaign.contacts.stiffness_of = Contacts::StiffnessOf::parcel;
  for (auto& [name, pair] : campaign.contacts.pairs) pair = {0.5, 0.1, 0};
  campaign.drag = DragLaw::ergun;
  campaign.dem.gas = DemSettings::GasModel::transient;
  campaign.dem.void_fraction = DemSettings::VoidFraction::smoothed;
  campaign.dem.smoothing_length = 0.012;
  campaign.scene.geometry.sides = Geometry::Sides::periodic;
  campaign.scene.geometry.depth = column.depth;
  campaign.scene.geometry.profile = {{0, column.half_width}, {column.height, column.half_width}};
  campaign.scene.mesh.cell = 0.012;
  campaign.charging.stock_line = column.height;
  campaign.charging.hopper_height = 0.02;
  blow_through(campaign, gas_density_of_scene * speed * 2 * column.half_width * column.depth, gas_density_of_scene,
               viscosity);
  return campaign;
}

/// Ergun (1952): speed at which the pressure falls by the bed's weight, m/s.
double ergun_speed(double void_fraction) {
  const double solids = 1 - void_fraction, cube = std::pow(void_fraction, 3);
  const double linear = 150 * viscosity * solids * solids / (cube * grain * grain);
  const double square = 1.75 * gas_density_of_scene * solids / (cube * grain);
  const double weight = solids * grain_density * gravity;
  return (std::sqrt(linear * linear + 4 * square * weight) - linear) / (2 * square);
}

double upward_momentum(const Engine& engine) {
  double momentum = 0;
  for (const auto& parcel : everyone(engine)) momentum += parcel.mass * parcel.velocity[2];
  return momentum;
}

Curve fluidise(const Column& column, double coarse_graining) {
  const auto begun = std::chrono::steady_clock::now();
  const Campaign first = case_a(column, coarse_graining, column.speeds.front());
  GasScene scene(first);
  const double step = 0.1 * dem_time_step(first).reference;
  auto engine = box_engine(first, step);
  const double area = 2 * column.half_width * column.depth;
  const double parcel_volume = parcel_mass(first.species[0]) / grain_density;
  engine->add(poured(first, column.height, static_cast<std::size_t>(0.58 * area * column.bed / parcel_volume)));
  Curve curve;
  curve.parcels = static_cast<double>(engine->count());
  const double weight = curve.parcels * parcel_volume * grain_density * gravity / area;
  const auto in_steps = [&](double seconds) { return std::lround(seconds / step); };
  engine->advance(in_steps(0.25));  // down to the floor, without gas
  SolidsOnMesh solids(scene.mesh, first, MPI_COMM_WORLD);
  for (const double speed : column.speeds) {
    // Each speed begins with gas at rest, which is in motion after some steps of it.
    const Campaign campaign = case_a(column, coarse_graining, speed);
    const std::vector<double> temperature(scene.mesh.cells(), gas_temperature);
    const auto gas = make_dem_gas(scene.foam, scene.mesh, campaign, temperature, MPI_COMM_WORLD);
    const double block = 4e-3;
    for (double time = 0; time < column.settle; time += block)
      advance_with_gas(*engine, solids, *gas, step, in_steps(block));
    double impulse = 0, time_seen = 0;
    const double momentum = upward_momentum(*engine);
    for (double time = 0; time < column.average; time += block) {
      advance_with_gas(*engine, solids, *gas, step, in_steps(block), [&](double seconds) {
        const double inlet = gas->summary()["inlets"][0]["pressure"];
        impulse += seconds * (inlet - campaign.scene.gas->outlet_pressure);
        time_seen += seconds;
      });
    }
    // Without what set the bed in motion meanwhile.
    const double gained = (upward_momentum(*engine) - momentum) / area;
    curve.drop.push_back((impulse - gained) / time_seen / weight);
  }
  double volume = 0, gas_volume = 0;
  for (std::size_t cell = 0; cell < scene.mesh.cells(); ++cell) {
    const double z = scene.mesh.cell_centre[cell][2];
    if (z > 0.7 * column.bed || z < 0.2 * column.bed) continue;
    volume += scene.mesh.cell_volume[cell];
    gas_volume += scene.mesh.cell_volume[cell] - solids.volume()[cell];
  }
  curve.void_fraction = gas_volume / volume;
  curve.wall_seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - begun).count();
  return curve;
}

/// Speed at which the fixed bed's curve, a parabola through nought and its two lowest speeds, reaches the weight.
double minimum_fluidisation(const Column& column, const Curve& curve) {
  const std::size_t last = column.speeds.size() - 1;
  const double u1 = column.speeds[last], u2 = column.speeds[last - 1];
  const double square = (curve.drop[last - 1] / u2 - curve.drop[last] / u1) / (u2 - u1);
  const double linear = curve.drop[last] / u1 - square * u1;
  return (std::sqrt(linear * linear + 4 * square) - linear) / (2 * square);
}

/// @param plateau, onset tolerances of the pressure drop and of u_mf, relative
void expect_the_curve(const Column& column, const Curve& curve, const std::string& what, double plateau, double onset) {
  const double measured = minimum_fluidisation(column, curve);
  const double exact = ergun_speed(curve.void_fraction);
  for (std::size_t i = 0; i < column.speeds.size(); ++i)
    fmt::print("{}: {:.2f} m/s: {:.4f} of the weight\n", what, column.speeds[i], curve.drop[i]);
  fmt::print("{}: {} parcels, void fraction {:.3f}, u_mf {:.3f} m/s, Ergun {:.3f}, {:.1f} s of wall time\n", what,
             curve.parcels, curve.void_fraction, measured, exact, curve.wall_seconds);
  for (std::size_t i = 0; i < column.speeds.size(); ++i) {
    if (column.speeds[i] < 1.2 * exact) continue;
    EXPECT_NEAR(curve.drop[i], 1, plateau) << what << ", " << column.speeds[i];
  }
  EXPECT_LT(curve.drop.back(), 0.7) << what;
  EXPECT_NEAR(measured / exact, 1, onset) << what;
}

TEST(Fluidisation, OfParcelsHasThePlateauOfTheWeightAndErgunsSpeed) {
  const Column small{0.024, 0.03, 0.15, 0.05, 1e3, 0.15, 0.3, {1.5, 0.8, 0.6}};
  // So small a column is short of the plateau (bubbles as wide as it, between which some of the bed rests on the
  // floor), and its walls take a larger share in u_mf than the one below.
  expect_the_curve(small, fluidise(small, 1.5), "representative particles", 0.04, 0.12);
}

/// The source's stiffness and both sizes; minutes long.
TEST(FluidisationInFull, GrainsAndRepresentativeParticlesHaveTheSameCurve) {
  const Column column{0.03, 0.024, 0.36, 0.14, 1e4, 0.3, 0.6, {1.4, 0.8, 0.6}};
  const Curve grains = fluidise(column, 1), parcels = fluidise(column, 1.5);
  expect_the_curve(column, grains, "grains", 0.02, 0.1);
  expect_the_curve(column, parcels, "representative particles", 0.02, 0.1);
  fmt::print("grains take {:.2f} times as long; published: 3.7 and 4.22\n", grains.wall_seconds / parcels.wall_seconds);
  EXPECT_GT(grains.wall_seconds, parcels.wall_seconds);
}

}  // namespace
}  // namespace cupola::test
