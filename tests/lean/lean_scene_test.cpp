#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>
#include <fstream>
#include <iostream>
#include <map>
#include <regex>
#include <set>

#include "tests/support/stated_bed.hpp"
#include "tests/support/tracer_program.hpp"
#include "tests/verification/tracer/column.hpp"

/// Only what the scene needs, counted by callgrind: which of the program's functions are called at all, and how many
/// instructions a scene costs.  The program is the one that is installed, on one rank.
namespace cupola::testing {
namespace {

/// A march under callgrind.
struct Counted {
  std::set<std::string> called;   ///< functions that were called
  double instructions = 0;        ///< of the whole program
  std::set<std::string> written;  ///< datasets of result and checkpoints
  nlohmann::json summary;
  [[nodiscard]] bool calls(const std::string& pattern) const {
    const std::regex wanted(pattern);
    for (const std::string& name : called)
      if (std::regex_search(name, wanted)) return true;
    return false;
  }
};

void names_below(const HdfReader& file, const std::string& group, std::set<std::string>& names) {
  for (const std::string& name : file.names(group)) {
    const std::string path = group.empty() ? name : group + "/" + name;
    names.insert(path);
    names_below(file, path, names);
  }
}

Counted count(const Campaign& campaign) {
  const TracerProgram program(campaign,
                              [](const BedMesh& mesh, const Campaign& c) { return bed_at_rest(mesh, c, 0.6); });
  const std::string out = (program.path() / "callgrind.log").string();
  // The variable without which the program would start itself anew, which valgrind does not take.
  const std::string command = fmt::format(
      "WM_PROJECT_DIR=/usr/share/openfoam valgrind --tool=callgrind --compress-strings=no --callgrind-out-file={} {} "
      "{} > /dev/null 2>&1",
      out, CUPOLA_TRACER, program.path().string());
  EXPECT_EQ(std::system(command.c_str()), 0) << program.failure();
  Counted counted;
  std::ifstream file(out);
  for (std::string line; std::getline(file, line);) {
    if (line.starts_with("fn=")) counted.called.insert(line.substr(3));
    if (line.starts_with("summary: ")) counted.instructions = std::stod(line.substr(9));
  }
  counted.summary = program.result().summary();
  names_below(program.result().hdf(), "", counted.written);
  for (const char* checkpoint : {"checkpoint-A.h5", "checkpoint-B.h5"})
    if (std::filesystem::exists(program.path() / checkpoint))
      names_below(HdfReader(program.path() / checkpoint), "", counted.written);
  return counted;
}

Campaign hot() {
  Campaign campaign = column_campaign(10);
  campaign.tracer.duration = 5;
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
  return campaign;
}

const char* const energy =
    "cupola::(GasEnergy::|HeatStep::advance|Conduction::(advance|links|steady)|set_temperatures|mean_temperature|"
    "enthalpy)";
const char* const flow = "cupola::(DarcyForchheimer|NavierStokes|BedFlow|GasModel)::";
const char* const zone = "cupola::find_melting_zone";

TEST(LeanScene, ColdSceneOfOneSpeciesDoesNothingOfHeatAndGas) {
  const Counted lean = count(cold());
  EXPECT_FALSE(lean.calls(energy));
  EXPECT_FALSE(lean.calls(flow));
  EXPECT_FALSE(lean.calls(zone));
  EXPECT_EQ(lean.summary.value("energy_solves", 0), 0);
  EXPECT_EQ(lean.summary.value("flow_solves", 0), 0);
  for (const std::string& name : lean.written) {
    EXPECT_EQ(name.find("emperature"), std::string::npos) << name;
    EXPECT_EQ(name.find("CohesiveZone"), std::string::npos) << name;
  }
  // The same names in a scene that has both: else this test could not fail.
  const Counted full = count(hot());
  EXPECT_TRUE(full.calls(energy));
  EXPECT_TRUE(full.calls(flow));
  EXPECT_FALSE(full.calls(zone)) << "nothing softens in this scene either";
  EXPECT_GT(full.summary.value("energy_solves", 0), 0);
  EXPECT_LT(lean.instructions, full.instructions);
  std::cout << fmt::format("cold: {:.4g} instructions in {} functions; with heat and gas {:.4g} in {}\n",
                           lean.instructions, lean.called.size(), full.instructions, full.called.size());
}

TEST(LeanScene, AFeatureThatIsOffCostsNothing) {
  const double plain = count(cold()).instructions;
  // Softening, a table of properties and a guessed zone stand in the file, but nothing is hot.
  Campaign with = cold();
  with.species[0].softening = Softening{1475, 1675};
  with.initial.cohesive_zone = InvertedV{0.5, 0.5, 2400, 300};
  const double instructions = count(with).instructions;
  EXPECT_NEAR(instructions / plain, 1, 0.01);
  std::cout << fmt::format("cold: {:.6g} instructions, with softening in the file {:.6g}: {:+.3f} %\n", plain,
                           instructions, 100 * (instructions / plain - 1));
}

}  // namespace
}  // namespace cupola::testing
