#include <gtest/gtest.h>

#include "physics/gas/bed_gas.hpp"
#include "schemas/failure.hpp"
#include "tests/support/foam_scene.hpp"
#include "tests/support/furnaces.hpp"

namespace cupola {
namespace {

constexpr double inlet_temperature = 1200;

Campaign column(const Inlet& inlet) {
  Campaign campaign = furnaces::box();
  campaign.scene.gas->inlets = {inlet};
  return campaign;
}

Inlet blast(Inlet::Given given, double value) {
  Inlet inlet;
  inlet.name = "blast";
  inlet.side = Inlet::Side::bottom;
  inlet.total_temperature = inlet_temperature;
  inlet.given = given;
  (given == Inlet::Given::mass_flow  ? inlet.mass_flow
   : given == Inlet::Given::velocity ? inlet.velocity
                                     : inlet.pressure) = value;
  return inlet;
}

struct Answer {
  double mass_flow;  ///< kg/s
  InletState inlet;
};

Answer solve(const Inlet& inlet) {
  const Campaign campaign = column(inlet);
  FoamScene scene(campaign);
  DarcyForchheimer flow(scene.foam, scene.mesh, campaign);
  const auto result = flow.solve(uniform_bed(scene.mesh, 0.42, 5e-3),
                                 std::vector<double>(scene.mesh.cells(), inlet_temperature), 1e-10, 200);
  EXPECT_LT(result.change, 1e-9);
  EXPECT_LT(result.mass_residual, 5e-11);
  double blown = 0;
  const auto& patch = *scene.mesh.find_patch("blast");
  for (auto face = patch.first_face; face < patch.first_face + patch.faces; ++face)
    blown -= flow.face_mass_flux()[face];
  return {blown, flow.inlets()[0].state};
}

TEST(Openings, MassFlowPressureAndVelocitySayTheSame) {
  const Answer given = solve(blast(Inlet::Given::mass_flow, 0.5));
  EXPECT_NEAR(given.mass_flow, 0.5, 1e-10);
  EXPECT_GT(given.inlet.static_pressure, 1.05e5);  // so that the pressure matters
  const Answer pressed = solve(blast(Inlet::Given::pressure, given.inlet.static_pressure));
  EXPECT_NEAR(pressed.mass_flow, 0.5, 1e-7);
  EXPECT_NEAR(pressed.inlet.static_pressure, given.inlet.static_pressure, 1e-6);
  const Answer blown = solve(blast(Inlet::Given::velocity, given.inlet.velocity));
  EXPECT_NEAR(blown.mass_flow, 0.5, 1e-6);
  EXPECT_NEAR(blown.inlet.velocity, given.inlet.velocity, 1e-5 * given.inlet.velocity);
}

TEST(Openings, AVelocityWithoutAFlowIsAFailureThatSaysSo) {
  const Campaign campaign = column(blast(Inlet::Given::velocity, 60));
  FoamScene scene(campaign);
  DarcyForchheimer flow(scene.foam, scene.mesh, campaign);
  try {
    flow.solve(uniform_bed(scene.mesh, 0.42, 5e-4), std::vector<double>(scene.mesh.cells(), inlet_temperature), 1e-8,
               500);
    FAIL() << "a flow was found";
  } catch (const Failure& failure) {
    EXPECT_EQ(failure.code(), ExitCode::diverged);
    EXPECT_NE(std::string(failure.what()).find("grows without limit"), std::string::npos) << failure.what();
  }
}

}  // namespace
}  // namespace cupola
