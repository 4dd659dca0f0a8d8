#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "physics/closures/drag.hpp"
#include "physics/closures/gas_properties.hpp"
#include "physics/gas/bed_gas.hpp"
#include "schemas/failure.hpp"
#include "tests/support/foam_scene.hpp"
#include "tests/support/furnaces.hpp"

namespace cupola {
namespace {

constexpr double column_area = 0.6 * 0.4, column_height = 1.5;

/// A column whose gas cools from 2000 to 600 K, and whose void fraction falls from 0.8 to 0.4, on the way up: density
/// and the interstitial velocity change by factors.
double temperature_at(double z) { return 2000 - 1400 * z / column_height; }
double void_at(double z) { return 0.8 - 0.4 * z / column_height; }

Campaign column(double cell) {
  Campaign campaign = furnaces::box();
  campaign.drag = DragLaw::ergun;
  campaign.scene.mesh.cell = cell;
  campaign.scene.gas->viscosity = 1e-9;  // no shear: the equation below is exact
  campaign.scene.gas->inlets[0].mass_flow = 0.5;
  campaign.scene.gas->inlets[0].total_temperature = 2000;
  return campaign;
}

/// p^2 at the column's foot by its own equation, integrated downwards in small steps:
///   -dp/dz = r U + (G/e) du/dz,  u = G R T/(M p e).
double foot(const Campaign& campaign, bool inertia) {
  const Gas& gas = *campaign.scene.gas;
  const double specific = molar_gas_constant / gas.molar_mass;
  const double flux = gas.inlets[0].mass_flow / column_area;
  const auto velocity = [&](double p, double z) { return flux * specific * temperature_at(z) / (p * void_at(z)); };
  constexpr int steps = 20000;
  double p = gas.outlet_pressure;
  double u = velocity(p, column_height);
  for (int i = steps; i > 0; --i) {
    const double dz = column_height / steps, z = (i - 0.5) * dz;
    const double drag = drag_resistance(campaign.drag, void_at(z), 0.2, gas.viscosity, 1, flux) * flux * specific *
                        temperature_at(z) / p;
    double lower = p + drag * dz, below = u;
    for (int again = 0; inertia && again < 20; ++again) {
      below = velocity(lower, (i - 1) * dz);
      lower = p + drag * dz + flux / void_at(z) * (u - below);
    }
    p = lower;
    u = below;
  }
  return p * p;
}

/// p^2 as the flow model finds it in the lowest row of cells, brought to the foot, above what the jets' impact adds.
template <typename Flow>
double found(double cell) {
  const Campaign campaign = column(cell);
  FoamScene scene(campaign);
  auto bed = uniform_bed(scene.mesh, 0.42, 0.2);
  std::vector<double> temperature(scene.mesh.cells());
  for (std::size_t c = 0; c < scene.mesh.cells(); ++c) {
    temperature[c] = temperature_at(scene.mesh.cell_centre[c][2]);
    bed.void_fraction[c] = void_at(scene.mesh.cell_centre[c][2]);
  }
  Flow flow(scene.foam, scene.mesh, campaign);
  const auto result = flow.solve(bed, temperature, 1e-9, 300);
  EXPECT_LT(result.change, 1e-7);
  EXPECT_LT(result.mass_residual, 1e-10);
  const double foot = flow.inlets()[0].state.static_pressure;
  return foot * foot;
}

TEST(NavierStokes, ColumnOfChangingDensityFollowsItsEquationWithBothModels) {
  const Campaign campaign = column(0.1);
  const double drag_alone = foot(campaign, false), whole = foot(campaign, true);
  const double effect = whole - drag_alone;
  ASSERT_GT(std::abs(effect), 0.02 * (drag_alone - 1e10));  // inertia matters here
  // Ergun's column, cold above hot.
  EXPECT_NEAR(found<DarcyForchheimer>(0.05), drag_alone, 5e-3 * (drag_alone - 1e10));
  // The jets of the whole foot are slower than the gas between the grains: their impact is a pressure of its own,
  //   (G/e) (u_bed - u_jet) at the foot.
  const Gas& gas = *campaign.scene.gas;
  const double flux = gas.inlets[0].mass_flow / column_area;
  const double p = std::sqrt(whole);
  const double jet = flux * molar_gas_constant / gas.molar_mass * 2000 / p;
  const double impact = 2 * p * flux / void_at(0) * (jet / void_at(0) - jet);
  std::vector<double> errors;
  for (const double cell : {0.1, 0.05}) {
    const double inertia = found<NavierStokes>(cell) - found<DarcyForchheimer>(cell);
    errors.push_back(std::abs(inertia - (effect + impact)) / std::abs(effect + impact));
  }
  EXPECT_LT(errors[1], 0.05);
  EXPECT_LT(errors[1], 0.75 * errors[0]);  // first-order upwind
}

/// Two tuyeres into raceways of void fraction 0.9 in the shaft.
struct Slot {
  static Campaign make() {
    Campaign campaign = furnaces::shaft();
    campaign.charging.stock_line = 7.6;
    return campaign;
  }
  Campaign campaign = make();
  FoamScene scene{campaign};
  BedState bed = uniform_bed(scene.mesh, 0.42, 0.03);
  std::vector<double> temperature = std::vector<double>(scene.mesh.cells(), 1600);
  Slot() {
    for (std::size_t c = 0; c < scene.mesh.cells(); ++c) {
      if (to_tuyere(c) < 0.6) bed.void_fraction[c] = 0.9;
    }
  }
  [[nodiscard]] double to_tuyere(std::size_t cell) const {
    const Vector3& x = scene.mesh.cell_centre[cell];
    return std::hypot(std::abs(x[0]) - 1.5, x[1], x[2] - 0.06);
  }
};

TEST(NavierStokes, AgreesWithDarcyForchheimerAwayFromTheTuyeres) {
  Slot slot;
  DarcyForchheimer darcy(slot.scene.foam, slot.scene.mesh, slot.campaign);
  darcy.solve(slot.bed, slot.temperature, 1e-7, 100);
  NavierStokes navier(slot.scene.foam, slot.scene.mesh, slot.campaign);
  const auto result = navier.solve(slot.bed, slot.temperature, 1e-6, 300);
  EXPECT_LE(result.change, 1e-6);
  EXPECT_LT(result.mass_residual, 1e-10);
  double near = 0, near_all = 0, far = 0, far_all = 0;
  std::array<double, 3> by_third_darcy{}, by_third_navier{};
  for (std::size_t c = 0; c < slot.scene.mesh.cells(); ++c) {
    const Vector3 &a = darcy.mass_flux()[c], &b = navier.mass_flux()[c];
    double difference = 0, all = 0;
    for (std::size_t k = 0; k < 3; ++k) {
      difference += (a[k] - b[k]) * (a[k] - b[k]);
      all += a[k] * a[k];
    }
    const double v = slot.scene.mesh.cell_volume[c];
    const bool away = slot.to_tuyere(c) > 2.5;
    (away ? far : near) += v * difference;
    (away ? far_all : near_all) += v * all;
    const Vector3& x = slot.scene.mesh.cell_centre[c];
    if (std::abs(x[2] - 3) < 0.1) {
      const auto third =
          static_cast<std::size_t>(std::clamp(1.5 * (x[0] / slot.campaign.half_width(x[2]) + 1), 0.0, 2.9));
      by_third_darcy[third] += v * a[2];
      by_third_navier[third] += v * b[2];
    }
  }
  EXPECT_LT(std::sqrt(far / far_all), 0.01);
  EXPECT_GT(std::sqrt(near / near_all), 0.05);  // in and about the raceways inertia matters
  const double whole = by_third_darcy[0] + by_third_darcy[1] + by_third_darcy[2];
  for (std::size_t i = 0; i < 3; ++i) EXPECT_NEAR(by_third_navier[i] / whole, by_third_darcy[i] / whole, 0.003);
}

TEST(NavierStokes, GoesOnFromItsWarmStartBitByBit) {
  Slot slot;
  NavierStokes first(slot.scene.foam, slot.scene.mesh, slot.campaign);
  first.solve(slot.bed, slot.temperature, 1e-4, 100);
  const auto start = first.warm_start();
  const auto face_pressure = first.face_pressure();
  const auto inertia = first.inertia_over_drag();
  for (double& t : slot.temperature) t *= 1.02;
  first.solve(slot.bed, slot.temperature, 1e-2, 2);
  NavierStokes again(slot.scene.foam, slot.scene.mesh, slot.campaign);
  again.restore(start, face_pressure, inertia);
  again.solve(slot.bed, slot.temperature, 1e-2, 2);
  EXPECT_EQ(again.warm_start().face_mass_flux, first.warm_start().face_mass_flux);
}

TEST(NavierStokes, GasFasterThanItsHeatIsAFailureThatAdvisesDarcyForchheimer) {
  Slot slot;
  for (auto& inlet : slot.campaign.scene.gas->inlets) inlet.mass_flow = 200;
  slot.bed = uniform_bed(slot.scene.mesh, 0.95, 2);  // hardly any drag that would raise the pressure
  NavierStokes flow(slot.scene.foam, slot.scene.mesh, slot.campaign);
  try {
    flow.solve(slot.bed, slot.temperature, 1e-6, 100);
    FAIL() << "a flow was found";
  } catch (const Failure& failure) {
    EXPECT_EQ(failure.code(), ExitCode::diverged);
    EXPECT_EQ(failure.advice().at("tracer.gas"), "darcy-forchheimer");
  }
}

}  // namespace
}  // namespace cupola
