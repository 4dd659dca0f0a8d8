#include <fmt/format.h>
#include <gtest/gtest.h>

#include <iostream>

#include "tests/lean/counted_program.hpp"
#include "tests/support/stated_bed.hpp"
#include "tests/support/tracer_program.hpp"
#include "tests/verification/tracer/column.hpp"

/// The tracer stage does only what its scene needs.
namespace cupola::testing {
namespace {

struct March {
  Counted counted;
  nlohmann::json summary;
};

March march(const Campaign& campaign) {
  const TracerProgram program(campaign,
                              [](const BedMesh& mesh, const Campaign& c) { return bed_at_rest(mesh, c, 0.6); });
  March march{count(CUPOLA_TRACER, program.path(), "cupola::TracerStage::run()"), {}};
  march.summary = program.result().summary();
  return march;
}

Campaign hot() {
  Campaign campaign = column_campaign(10);
  campaign.tracer.duration = 100;
  return campaign;
}

/// The same without heat and gas.
Campaign cold() {
  Campaign campaign = hot();
  campaign.heat.reset();
  campaign.scene.gas.reset();
  campaign.scene.heat_loss.reset();
  campaign.dem.gas = DemSettings::GasModel::none;
  campaign.tracer.gas = TracerSettings::GasModel::none;
  for (Species& species : campaign.species) species.heat_capacity = species.conductivity = 0;
  return campaign;
}

const char* const energy =
    "cupola::(GasEnergy::|HeatStep::advance|Conduction::(advance|links|steady)|set_temperatures|mean_temperature|"
    "enthalpy)";
const char* const flow = "cupola::(DarcyForchheimer|NavierStokes|BedFlow|GasModel)::";
const char* const flow_solver = "Foam::lduMatrix::lduMatrix|Foam::fvMatrix<double>::fvMatrix";
const char* const zone = "cupola::find_melting_zone";

TEST(LeanTracerScene, ColdSceneOfOneSpeciesDoesNothingOfHeatAndGas) {
  const auto [lean, lean_summary] = march(cold());
  for (const char* piece : {energy, flow, flow_solver, zone}) EXPECT_FALSE(lean.calls(piece)) << piece;
  EXPECT_EQ(lean_summary.value("energy_solves", 0), 0);
  EXPECT_EQ(lean_summary.value("flow_solves", 0), 0);
  for (const std::string& name : lean.written) {
    EXPECT_EQ(name.find("emperature"), std::string::npos) << name;
    EXPECT_EQ(name.find("CohesiveZone"), std::string::npos) << name;
  }
  // The same pieces are found in a scene that has them: else this test could not fail.
  const auto [full, full_summary] = march(hot());
  for (const char* piece : {energy, flow, flow_solver}) EXPECT_TRUE(full.calls(piece)) << piece;
  EXPECT_FALSE(full.calls(zone)) << "nothing softens in this scene either";
  EXPECT_TRUE(has_function(CUPOLA_TRACER, zone));
  EXPECT_GT(full_summary.value("energy_solves", 0), 0);
  EXPECT_LT(lean.instructions, full.instructions);
  std::cout << fmt::format("cold: {:.4g} instructions of the march; with heat and gas {:.4g}\n", lean.instructions,
                           full.instructions);
}

TEST(LeanTracerScene, AFeatureThatIsOffCostsNothing) {
  const double plain = march(cold()).counted.instructions;
  // Softening, a table of properties and a guessed zone stand in the file, but nothing is hot.
  Campaign with = cold();
  with.species[0].softening = Softening{1475, 1675};
  with.species[0].heat_capacity = PropertyCurve(std::vector<PropertyCurve::Point>{{300, 800}, {1000, 900}});
  with.initial.cohesive_zone = InvertedV{0.5, 0.5, 2400, 300};
  const double instructions = march(with).counted.instructions;
  EXPECT_NEAR(instructions / plain, 1, 0.01);
  std::cout << fmt::format("cold: {:.6g} instructions, with softening in the file {:.6g}: {:+.3f} %\n", plain,
                           instructions, 100 * (instructions / plain - 1));
}

}  // namespace
}  // namespace cupola::testing
