#include <fmt/format.h>
#include <gtest/gtest.h>

#include <iostream>

#include "schemas/campaign_reader.hpp"
#include "schemas/files.hpp"
#include "schemas/task.hpp"
#include "schemas/version.hpp"
#include "tests/lean/counted_program.hpp"
#include "tests/support/child_process.hpp"
#include "tests/support/temporary_folder.hpp"

/// The DEM stage does only what its scene needs.
namespace cupola::testing {
namespace {

constexpr const char* cold = R"(
campaign: cold
scene:
  geometry: {slot: {depth: 0.4 m, profile: [[0, 0.4], [0.5, 0.4], [1.2, 0.3]]}}
  mesh: {cell: 0.13 m}
species:
  coke: {diameter: 44 mm, coarse_graining: 3, density: 800 kg/m3}
contacts:
  youngs_modulus: 5 MPa
  pairs:
    coke-coke: {restitution: 0.5, friction: 0.5, rolling: 0.1}
    coke-wall: {restitution: 0.5, friction: 0.3, rolling: 0.02}
charging: {stock_line: 0.9 m, layers: [{coke: 22 kg}]}
raceways:
  - {box: {x: [-0.4 m, -0.2 m], y: [-0.2 m, 0.2 m], z: [0.1 m, 0.4 m]}, dem_removal_rate: 5 kg/s}
descent_rate: 2 mm/s
dem: {relaxation: 0, window: 0.1 s, stop: {when: duration}}
launch: {ranks: 1}
)";

/// What couples gas and parcels, and what a temperature makes of them.
const char* const gas = "cupola::(GasCoupling|BedFlow|DarcyForchheimer|Openings)::";
const char* const flow_solver = "Foam::(lduMatrix::lduMatrix|fvMatrix<double>::fvMatrix)";
const char* const turbulence = "cupola::(Turbulence::|make_turbulence)";
const char* const softening = "cupola::(soften|regrow|melted)[(]";

/// The cold scene's bed, poured uncounted, and the stage that goes on from it.
class LeanDemScene : public ::testing::Test {
 protected:
  LeanDemScene() {
    const auto campaign_file = folder_.path() / "campaign.yaml";
    write_text_atomically(campaign_file, cold);
    task_.kind = TaskKind::dem;
    task_.campaign = load_campaign(campaign_file);
    task_.campaign_hash = hash_text(cold);
    task_.program_version = program_version;
  }

  void SetUp() override {
    const auto poured = folder_.path() / "poured";
    ASSERT_EQ(prepare(poured), 0);
    ASSERT_EQ(wait_for(start({CUPOLA_DEM, poured.string()})), 0);
    task_.inputs["packing"] = {(poured / "result.hdf").string(), hash_file(poured / "result.hdf")};
  }

  [[nodiscard]] const Campaign& scene() const { return task_.campaign; }

  Counted counted(const std::string& name, const Campaign& campaign) {
    task_.campaign = campaign;
    const auto place = folder_.path() / name;
    EXPECT_EQ(prepare(place), 0);
    return count(CUPOLA_DEM, place, "cupola::DemStage::run()");
  }

 private:
  int prepare(const std::filesystem::path& place) {
    std::filesystem::create_directories(place);
    write_task(place, task_);
    return wait_for(start({CUPOLA_DEM, "prepare", place.string()}));
  }

  TemporaryFolder folder_;
  Task task_;
};

TEST_F(LeanDemScene, WithoutHeatAndGasNoFlowSolverIsConstructedAndAFeatureThatIsOffCostsNothing) {
  const Counted lean = counted("lean", scene());
  EXPECT_TRUE(lean.calls("cupola::DemStage::advance_block"));
  for (const char* piece : {gas, flow_solver, turbulence, softening}) EXPECT_FALSE(lean.calls(piece)) << piece;
  for (const char* piece : {gas, turbulence, softening}) EXPECT_TRUE(has_function(CUPOLA_DEM, piece)) << piece;
  for (const std::string& name : lean.written) {
    EXPECT_EQ(name.find("emperature"), std::string::npos) << name;
    EXPECT_EQ(name.find("gas"), std::string::npos) << name;
  }
  // A table of properties, a guessed zone and another drag law stand in the file, but nothing is hot and no gas flows.
  Campaign with = scene();
  with.species[0].heat_capacity = PropertyCurve(std::vector<PropertyCurve::Point>{{300, 800}, {1000, 900}});
  with.species[0].conductivity = 2;
  with.initial.cohesive_zone = InvertedV{0.5, 0.5, 2400, 300};
  with.drag = DragLaw::emms;
  const double plain = lean.instructions, instructions = counted("with", with).instructions;
  EXPECT_NEAR(instructions / plain, 1, 0.01);
  std::cout << fmt::format("{:.6g} instructions of the stage in {} functions, with what is off in the file {:+.3f} %\n",
                           plain, lean.called.size(), 100 * (instructions / plain - 1));
}

}  // namespace
}  // namespace cupola::testing
