#include <gtest/gtest.h>

#include <algorithm>
#include <cstdio>
#include <functional>
#include <limits>

#include "schemas/campaign_reader.hpp"
#include "schemas/files.hpp"
#include "tests/support/tracer_program.hpp"
#include "tests/verification/tracer/column.hpp"

namespace cupola {
namespace {

constexpr double solids_fraction = 0.55;
constexpr int rows = 10;

Campaign tiny() {
  Campaign campaign = load_campaign(std::filesystem::path(CUPOLA_SOURCE_DIR) / "cases" / "tiny" / "campaign.yaml");
  campaign.tracer.duration = 300;
  return campaign;
}

testing::StatedBed even(const BedMesh& mesh, const Campaign& campaign) {
  return testing::bed_at_rest(mesh, campaign, solids_fraction);
}

/// The same fields without a single parcel.
testing::StatedBed without_parcels(const testing::StatedBed& bed) {
  testing::StatedBed none;
  none.solids_fraction = bed.solids_fraction;
  none.solids_velocity = bed.solids_velocity;
  return none;
}

/// A right answer: every number finite, no temperature outside what is put in, balances closed.
void expect_sound(const testing::TracerProgram& program, double coldest, double hottest) {
  ASSERT_EQ(program.run(), 0) << program.failure();
  const FieldFile result = program.result();
  for (const std::string& name : result.cell_data_names()) {
    const std::size_t columns = name == "solids_velocity" || name == "gas_mass_flux" ? 3 : 1;
    for (const double value : result.cell_data(name, columns)) ASSERT_TRUE(std::isfinite(value)) << name;
  }
  for (const char* name : {"gas_temperature", "solids_temperature"}) {
    for (const double value : result.cell_data(name)) {
      ASSERT_GE(value, coldest - 0.5) << name;
      ASSERT_LE(value, hottest + 0.5) << name;
    }
  }
  for (const double value : program.tracers().temperature) {
    ASSERT_GE(value, coldest - 0.5);
    ASSERT_LE(value, hottest + 0.5);
  }
  const nlohmann::json ledger = result.summary()["ledger"];
  EXPECT_LT(ledger["mass"]["residual"].get<double>(), 1e-9);
  EXPECT_LT(ledger["energy"]["residual"].get<double>(), 1e-3);
}

/// A clear error: the status, and a sentence that says what it is about.
void expect_refused(const testing::TracerProgram& program, int status, const std::string& about) {
  EXPECT_EQ(program.run(), status);
  EXPECT_NE(program.failure().find(about), std::string::npos) << program.failure();
  EXPECT_FALSE(std::filesystem::exists(program.path() / "result.hdf"));
}

TEST(BadInput, GranularFieldOfAnotherMesh) {
  const testing::TracerProgram other(testing::column_campaign(rows + 1), even);
  testing::TracerProgram program(testing::column_campaign(rows), even);
  program.take_granular(other.path() / "granular.hdf");
  expect_refused(program, 65, "mesh");
}

TEST(BadInput, FieldWithANumberThatIsNone) {
  for (const int which : {0, 1}) {
    const testing::TracerProgram program(
        testing::column_campaign(rows), [&](const BedMesh& mesh, const Campaign& campaign) {
          testing::StatedBed bed = even(mesh, campaign);
          (which == 0 ? bed.solids_fraction[3] : bed.solids_velocity[3][2]) = std::numeric_limits<double>::quiet_NaN();
          return bed;
        });
    expect_refused(program, 65, which == 0 ? "solids_fraction" : "solids_velocity");
  }
}

TEST(BadInput, NoTracer) {
  const testing::TracerProgram program(
      testing::column_campaign(rows),
      [](const BedMesh& mesh, const Campaign& campaign) { return without_parcels(even(mesh, campaign)); });
  expect_refused(program, 65, "parcel");
}

TEST(BadInput, NoGasInlet) {
  Campaign campaign = testing::column_campaign(rows);
  campaign.scene.gas->inlets.clear();
  try {
    const testing::TracerProgram program(campaign, even);
    FAIL() << "a gas without an inlet was accepted";
  } catch (const std::runtime_error& error) {
    EXPECT_NE(std::string(error.what()).find("inlets"), std::string::npos) << error.what();
  }
}

TEST(BadInput, OneTracer) {
  const testing::TracerProgram program(testing::column_campaign(rows),
                                       [](const BedMesh& mesh, const Campaign& campaign) {
                                         const testing::StatedBed bed = even(mesh, campaign);
                                         testing::StatedBed one = without_parcels(bed);
                                         one.add_parcel(0, bed.position[7], bed.radius[7], bed.mass[7]);
                                         return one;
                                       });
  expect_sound(program, 300, 1300);
}

TEST(BadInput, TenThousandTracersInOneCell) {
  const testing::TracerProgram program(testing::column_campaign(rows),
                                       [](const BedMesh& mesh, const Campaign& campaign) {
                                         testing::StatedBed bed = even(mesh, campaign);
                                         for (int k = 1; k < 10000; ++k)
                                           bed.add_parcel(0, bed.position[5], bed.radius[5], bed.mass[5] / 10000);
                                         return bed;
                                       });
  expect_sound(program, 300, 1300);
  EXPECT_GT(program.tracers().id.size(), 10000u);
}

TEST(BadInput, VoidFractionOfFivePercent) {
  const testing::TracerProgram program(
      testing::column_campaign(rows),
      [](const BedMesh& mesh, const Campaign& campaign) { return testing::bed_at_rest(mesh, campaign, 0.95); });
  expect_sound(program, 300, 1300);
  EXPECT_EQ(program.result().summary()["clamps"]["void_fraction_cells"].get<int>(), 2 * rows);
}

TEST(BadInput, CellWithoutGas) {
  for (const double full : {1.3, -0.1}) {
    const testing::TracerProgram program(testing::column_campaign(rows),
                                         [&](const BedMesh& mesh, const Campaign& campaign) {
                                           testing::StatedBed bed = even(mesh, campaign);
                                           bed.solids_fraction[4] = full;
                                           return bed;
                                         });
    expect_refused(program, 65, "no gas");
  }
}

TEST(BadInput, NusseltFactorOfAThousand) {
  Campaign campaign = testing::column_campaign(rows);
  campaign.heat->nusselt_factor = 1000;
  const testing::TracerProgram program(campaign, even);
  expect_sound(program, 300, 1300);
}

/// A shaft through the bed without any solids takes nearly all of the gas, and leaves it as hot as it came.
TEST(BadInput, HoleThroughWhichAllGasChannels) {
  Campaign campaign = testing::column_campaign(rows);
  campaign.species[0].diameter = 1e-3;
  const testing::TracerProgram program(campaign, [](const BedMesh& mesh, const Campaign& c) {
    const testing::StatedBed whole = even(mesh, c);
    testing::StatedBed bed = whole;
    bed.id.clear(), bed.species.clear(), bed.position.clear(), bed.radius.clear(), bed.mass.clear();
    for (std::size_t k = 0; k < mesh.cells(); ++k) {
      if (mesh.cell_centre[k][0] < 0) {
        bed.solids_fraction[k] = 0;
      } else {
        bed.add_parcel(0, whole.position[k], whole.radius[k], whole.mass[k]);
      }
    }
    return bed;
  });
  expect_sound(program, 300, 1300);
  const auto flux = program.result().cell_data("gas_mass_flux", 3);
  double in_hole = 0;
  double in_all = 0;
  for (std::size_t c = 0; c < program.mesh().cells(); ++c) {
    in_all += flux[3 * c + 2];
    if (program.mesh().cell_centre[c][0] < 0) in_hole += flux[3 * c + 2];
  }
  std::printf("%.3f of the gas goes through the hole\n", in_hole / in_all);
  EXPECT_GT(in_hole, 0.9 * in_all);
}

/// A guessed zone so low that solid ore lies in front of the tuyeres.
TEST(BadInput, CohesiveZoneThatCoversTheTuyere) {
  Campaign campaign = tiny();
  campaign.initial.cohesive_zone->tip = 0.1;
  for (Species& species : campaign.species) {
    if (species.softening) species.none_below = campaign.bottom();
  }
  const testing::TracerProgram program(campaign);
  expect_sound(program, 293, 2400);
}

}  // namespace
}  // namespace cupola
