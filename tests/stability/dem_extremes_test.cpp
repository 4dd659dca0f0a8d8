#include <fmt/format.h>
#include <gtest/gtest.h>

#include <chrono>
#include <cmath>
#include <functional>
#include <iostream>

#include "physics/plan/dem_time_step.hpp"
#include "schemas/failure.hpp"
#include "stage_dem/parcels.hpp"
#include "stage_dem/solids_on_mesh.hpp"
#include "tests/support/box_mesh.hpp"
#include "tests/unit/dem/box_scene.hpp"

/// The DEM stage's engine on stiff and extreme contacts, each at the time step that the program itself would take
/// (`time_step: auto`).  Two parcels meet head on at 1 m/s each; or a heap settles under gravity.  A collision must
/// give back the restitution put in and never energy; a heap must come to rest inside the box.  Each prints a row of
/// the table in docs/stability.md.
namespace cupola::test {
namespace {

struct Collision {
  std::string name;
  std::string what;
  std::function<void(Campaign&)> change;
  double restitution;
  std::string refusal;  ///< where it must be refused: part of the sentence
};

void modulus(Campaign& campaign, double value) {
  campaign.contacts.youngs_modulus = value;
  campaign.contacts.wall_youngs_modulus = value;
}

void restitution(Campaign& campaign, double value) { campaign.contacts.pairs["coke-ore"].restitution = value; }

std::vector<Collision> collisions() {
  const auto springs = [](double stiffness) {
    return [stiffness](Campaign& c) {
      c.contacts.model = Contacts::Model::linear_spring;
      c.contacts.stiffness = stiffness;
    };
  };
  return {
      {"ModulusSoftest", "Young's modulus 0.1 MPa", [](Campaign& c) { modulus(c, 1e5); }, 0.2, ""},
      {"ModulusSoft", "Young's modulus 1 MPa", [](Campaign& c) { modulus(c, 1e6); }, 0.2, ""},
      {"ModulusSteel", "Young's modulus 2x10^11 Pa", [](Campaign& c) { modulus(c, 2e11); }, 0.2, ""},
      {"ModulusAlumina", "Young's modulus 3.8x10^11 Pa", [](Campaign& c) { modulus(c, 3.8e11); }, 0.2, ""},
      {"RestitutionTiny", "restitution 0.01, Hertz", [](Campaign& c) { restitution(c, 0.01); }, 0.01,
       "0.05 < coefficientRestitution"},
      {"RestitutionTinySprings", "restitution 0.01, linear spring",
       [springs](Campaign& c) {
         springs(1e5)(c);
         restitution(c, 0.01);
       },
       0.01, ""},
      {"RestitutionLeast", "restitution 0.051, Hertz", [](Campaign& c) { restitution(c, 0.051); }, 0.051, ""},
      {"RestitutionOne", "restitution 1", [](Campaign& c) { restitution(c, 1); }, 1, ""},
      {"MassRatioThousand", "mass ratio 1000 in contact",
       [](Campaign& c) { c.species[1].density = 1000 * 800 * std::pow(0.1 / 0.08, 3); }, 0.2, ""},
      {"SizeRatioTen", "size ratio 10 in contact", [](Campaign& c) { c.species[1].diameter = 0.01 / 4; }, 0.2, ""},
      {"SpringSoft", "linear spring of 10^3 N/m", springs(1e3), 0.2, ""},
      {"SpringStiff", "linear spring of 10^8 N/m", springs(1e8), 0.2, ""},
  };
}

class DemCollisions : public ::testing::TestWithParam<Collision> {};

TEST_P(DemCollisions, GivesBackTheRestitutionPutIn) {
  const Collision& collision = GetParam();
  Campaign campaign = box_campaign();
  collision.change(campaign);
  const auto begin = std::chrono::steady_clock::now();
  const auto seconds = [&] { return std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count(); };
  const double step = dem_time_step(campaign).step;
  const Parcel coke = make_parcel(campaign, 1, 0, {-0.06, 0, 0.7}, {1, 0, 0});
  Parcel ore = make_parcel(campaign, 2, 1, {0, 0, 0.7}, {-1, 0, 0});
  ore.position[0] = coke.position[0] + coke.radius + ore.radius + 1e-3;
  const auto collide = [&] {
    auto engine = box_engine(campaign, step);
    engine->add({coke, ore});
    // In blocks, until they have parted: soft contacts last long, stiff ones want many steps.
    for (int block = 0; block < 400; ++block) {
      engine->advance(std::max(1L, static_cast<long>(1e-3 / step)));
      const auto now = everyone(*engine);
      if (now[1].velocity[0] > now[0].velocity[0] && now[1].position[0] - now[0].position[0] > coke.radius + ore.radius)
        break;
    }
    return everyone(*engine);
  };
  if (!collision.refusal.empty()) {
    try {
      collide();
      FAIL() << "accepted";
    } catch (const Failure& failure) {
      EXPECT_NE(std::string(failure.what()).find(collision.refusal), std::string::npos) << failure.what();
      std::cout << fmt::format("| DEM | {} | refused: \"{}\" | | | {:.1f} |\n", collision.what, failure.what(),
                               seconds());
    }
    return;
  }
  const auto after = collide();
  const double found = (after[1].velocity[0] - after[0].velocity[0]) / 2;
  EXPECT_NEAR(found, collision.restitution, 0.03);
  const double momentum = coke.mass * (after[0].velocity[0] - 1) + ore.mass * (after[1].velocity[0] + 1);
  const double turnover = std::min(coke.mass, ore.mass);
  EXPECT_LT(std::abs(momentum), 1e-9 * turnover + 1e-14 * std::max(coke.mass, ore.mass));
  double energy = 0;
  for (const Parcel& parcel : after) energy += 0.5 * parcel.mass * parcel.velocity[0] * parcel.velocity[0];
  EXPECT_LE(energy, 0.5 * (coke.mass + ore.mass) * (1 + 1e-3));
  std::cout << fmt::format("| DEM | {} | stable | restitution {:.3f} of {} | {:.2g} us | {:.1f} |\n", collision.what,
                           found, collision.restitution, 1e6 * step, seconds());
}

INSTANTIATE_TEST_SUITE_P(Engine, DemCollisions, ::testing::ValuesIn(collisions()),
                         [](const auto& info) { return info.param.name; });

struct Heap {
  std::string name;
  std::string what;
  std::function<void(Campaign&)> change;
};

std::vector<Heap> heaps() {
  const auto friction = [](double value) {
    return [value](Campaign& c) {
      for (auto& [pair, contact] : c.contacts.pairs) contact.friction = value;
    };
  };
  return {
      {"NoFriction", "friction 0", friction(0)},
      {"FrictionTwo", "friction 2", friction(2)},
      {"NoRolling", "no rolling friction", [](Campaign& c) { c.contacts.rolling_model = Contacts::Rolling::none; }},
      {"RestitutionLeast", "restitution 0.051 between all",
       [](Campaign& c) {
         for (auto& [pair, contact] : c.contacts.pairs) contact.restitution = 0.051;
       }},
      {"HeavyOnLight", "ore a hundred times as dense as coke",
       [](Campaign& c) { c.species[1].density = 100 * c.species[0].density; }},
  };
}

/// A parcel in a steady wind: u(t) = u_gas (1 - exp(-t/tau)), tau its drag relaxation time.
struct Wind {
  std::string name;
  std::string what;
  double relaxation;    ///< over the time step
  std::string refusal;  ///< part of the sentence where the step cannot follow it
};

class DemWinds : public ::testing::TestWithParam<Wind> {};

TEST_P(DemWinds, TakesTheParcelAlongAndNoFaster) {
  constexpr double wind = 0.1;  // m/s
  const auto begin = std::chrono::steady_clock::now();
  const Campaign campaign = box_campaign();
  const double step = dem_time_step(campaign).step;
  auto engine = box_engine(campaign, step);
  engine->add({make_parcel(campaign, 1, 0, {0, 0, 0.9})});
  const double damping = everyone(*engine)[0].mass / (GetParam().relaxation * step);
  const auto seconds = [&] { return std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count(); };
  if (!GetParam().refusal.empty()) {
    try {
      engine->set_forces({{{damping * wind, 0, 0}, damping}});
      FAIL() << "accepted";
    } catch (const Failure& failure) {
      EXPECT_NE(std::string(failure.what()).find(GetParam().refusal), std::string::npos) << failure.what();
      std::cout << fmt::format("| DEM | {} | refused: \"... {} ...\" | | {:.2g} us | {:.1f} |\n", GetParam().what,
                               GetParam().refusal, 1e6 * step, seconds());
    }
    return;
  }
  engine->set_forces({{{damping * wind, 0, 0}, damping}});
  // Not so long that it falls to the floor.
  const long steps = std::clamp(static_cast<long>(3 * GetParam().relaxation), 20L, static_cast<long>(0.3 / step));
  double last = 0;
  for (int part = 1; part <= 10; ++part) {
    engine->advance(std::max(1L, steps / 10));
    const double speed = everyone(*engine)[0].velocity[0];
    EXPECT_GE(speed, last - 1e-12 * wind) << "it does not swing";
    EXPECT_LE(speed, wind * (1 + 1e-12)) << "and never overtakes the gas";
    last = speed;
  }
  const double times = static_cast<double>(std::max(1L, steps / 10) * 10) / GetParam().relaxation;
  const double exact = wind * (1 - std::exp(-times));
  // An implicit step of first order: exact where the parcel follows at once, half a step off where it lags.
  EXPECT_NEAR(last, exact, wind * (0.005 + 0.5 / std::max(1.0, GetParam().relaxation) * (times < 10 ? 1 : 0)));
  std::cout << fmt::format("| DEM | {} | stable | speed {:.5f} of {:.5f} m/s | {:.2g} us | {:.1f} |\n", GetParam().what,
                           last, exact, 1e6 * step, seconds());
}

INSTANTIATE_TEST_SUITE_P(Engine, DemWinds,
                         ::testing::Values(Wind{"RelaxationMillionth", "drag relaxation time 10^-6 of the step", 1e-6,
                                                "less than the time step"},
                                           Wind{"RelaxationThousandth", "drag relaxation time 10^-3 of the step", 1e-3,
                                                "less than the time step"},
                                           Wind{"RelaxationOne", "drag relaxation time of one step", 1.001, ""},
                                           Wind{"RelaxationThousand", "drag relaxation time of 10^3 steps", 1e3, ""}),
                         [](const auto& info) { return info.param.name; });

/// Parcels of five cells' size, divided over the cells exactly or spread further by the kernel.
class DemWideParcels : public ::testing::TestWithParam<DemSettings::VoidFraction> {};

TEST_P(DemWideParcels, KeepTheirVolume) {
  const auto begin = std::chrono::steady_clock::now();
  Campaign campaign = box_campaign(0.25, 0.3, 0.5);
  campaign.dem.void_fraction = GetParam();
  campaign.dem.smoothing_length = 0.1;
  testing::BoxMesh box;  // cells of 0.02 m, parcels of 0.1 and 0.08 m
  box.cells = {25, 15, 25};
  box.lower = {-0.25, -0.15, 0};
  box.upper = {0.25, 0.15, 0.5};
  const BedMesh mesh = box.make();
  SolidsOnMesh solids(mesh, campaign, MPI_COMM_WORLD);
  const std::vector<Parcel> parcels = loose_parcels(campaign, 2);
  solids.divide(parcels);
  double in_cells = 0, in_parcels = 0, densest = 0;
  for (std::size_t cell = 0; cell < mesh.cells(); ++cell) {
    in_cells += solids.volume()[cell];
    densest = std::max(densest, solids.volume()[cell] / mesh.cell_volume[cell]);
    EXPECT_GE(solids.volume()[cell], -1e-15);
  }
  for (const Parcel& parcel : parcels) in_parcels += material_volume(campaign, parcel);
  EXPECT_NEAR(in_cells / in_parcels, 1, 1e-12);
  // Shares are found by points inside the parcel: with cells this small its volume comes in lumps, which the plan warns
  // of; the kernel spreads them.
  if (GetParam() == DemSettings::VoidFraction::smoothed) {
    EXPECT_LT(densest, 1);
  }
  std::cout << fmt::format(
      "| DEM | parcels five times the cell, void fraction {} | stable | volume to {:.1g}, at most {:.3f} of a cell | 1 "
      "| {:.1f} |\n",
      GetParam() == DemSettings::VoidFraction::smoothed ? "smoothed" : "divided", std::abs(in_cells / in_parcels - 1),
      densest, std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count());
}

INSTANTIATE_TEST_SUITE_P(Projection, DemWideParcels,
                         ::testing::Values(DemSettings::VoidFraction::divided, DemSettings::VoidFraction::smoothed),
                         [](const auto& info) {
                           return info.param == DemSettings::VoidFraction::smoothed ? "Smoothed" : "Divided";
                         });

class DemHeaps : public ::testing::TestWithParam<Heap> {};

TEST_P(DemHeaps, ComesToRestInTheBox) {
  Campaign campaign = box_campaign(0.25, 0.3, 1.0);
  GetParam().change(campaign);
  const auto begin = std::chrono::steady_clock::now();
  const double step = dem_time_step(campaign).step;
  auto engine = box_engine(campaign, step);
  engine->add(loose_parcels(campaign, 3));
  const auto parcels = engine->count();
  // The columns fall over for two seconds; grains under heavy ones rock on their rolling springs for some more.
  engine->advance(static_cast<long>(6.0 / step));
  EXPECT_EQ(engine->count(), parcels);
  double energy = 0;
  double mass = 0;
  for (const Parcel& parcel : everyone(*engine)) {
    for (const double v : parcel.velocity) energy += 0.5 * parcel.mass * v * v;
    mass += parcel.mass;
    EXPECT_LT(std::abs(parcel.position[0]), 0.25);
    EXPECT_GT(parcel.position[2], 0);
  }
  const double speed = std::sqrt(2 * energy / mass);
  EXPECT_LT(speed, 0.005);
  std::cout << fmt::format("| DEM | {} | stable | rms speed {:.1g} m/s after 6 s | {:.2g} us | {:.1f} |\n",
                           GetParam().what, speed, 1e6 * step,
                           std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count());
}

INSTANTIATE_TEST_SUITE_P(Engine, DemHeaps, ::testing::ValuesIn(heaps()),
                         [](const auto& info) { return info.param.name; });

}  // namespace
}  // namespace cupola::test
