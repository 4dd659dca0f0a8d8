#include <gtest/gtest.h>

#include <cstdio>

#include "schemas/campaign_reader.hpp"
#include "tests/support/tracer_program.hpp"

namespace cupola {
namespace {

Campaign tiny(double duration) {
  Campaign campaign = load_campaign(std::filesystem::path(CUPOLA_SOURCE_DIR) / "cases" / "tiny" / "campaign.yaml");
  campaign.tracer.duration = duration;
  return campaign;
}

/// Every kilogram and joule of a whole march, added up again from what the result says.
void check_ledger(const testing::TracerProgram& program, const Campaign& campaign) {
  const nlohmann::json summary = program.result().summary();
  const nlohmann::json& mass = summary["ledger"]["mass"];
  const nlohmann::json& energy = summary["ledger"]["energy"];
  const auto sum = [](const nlohmann::json& parts, const std::vector<const char*>& names) {
    double total = 0;
    for (const char* name : names) total += parts[name].get<double>();
    return total;
  };
  const double in = mass["in"].get<double>();
  const double out = sum(mass["out"], {"raceway", "melted", "unmelted", "lost"});
  const double mass_gap = in - out - mass["stored"].get<double>();
  const double energy_gap = sum(energy, {"blast", "charge"}) -
                            sum(energy, {"top_gas", "melt", "removed_coke", "unmelted", "lost", "walls", "stored"});
  const double blast = energy["blast"].get<double>();
  std::printf("mass: in %.6g kg, gap %.2g of it; energy: blast %.6g J, gap %.2g of it\n", in, mass_gap / in, blast,
              energy_gap / blast);
  EXPECT_GT(in, 0);
  EXPECT_LT(std::abs(mass_gap), 1e-11 * in);
  EXPECT_LT(std::abs(energy_gap), 1e-3 * blast);
  EXPECT_LT(std::abs(energy["residual"].get<double>()), 1e-3);
  EXPECT_EQ(mass["out"]["lost"].get<double>(), 0);
  // The stored mass is that of the tracers that are there.
  double now = 0;
  const testing::FinalTracers tracers = program.tracers();
  for (std::size_t i = 0; i < tracers.id.size(); ++i)
    now += tracers.volume[i] * campaign.species[static_cast<std::size_t>(tracers.species[i])].density;
  const auto parcels = FieldFile(program.path() / "granular.hdf", "dem-result");
  double before = 0;
  const auto parcel_mass = parcels.hdf().doubles("Packing/mass");
  const auto parcel_position = parcels.hdf().doubles("Packing/position");
  for (std::size_t p = 0; p < parcel_mass.size(); ++p) {
    if (parcel_position[3 * p + 2] < campaign.charging.stock_line) before += parcel_mass[p];
  }
  EXPECT_NEAR(mass["stored"].get<double>(), now - before, 1e-9 * before);
}

TEST(Ledger, ClosesOverAMarch) {
  const Campaign campaign = tiny(600);
  const testing::TracerProgram program(campaign);
  ASSERT_EQ(program.run(), 0) << program.failure();
  check_ledger(program, campaign);
}

TEST(LongLedger, ClosesOverAnEpisodeOfHoursOnTwoRanks) {
  const Campaign campaign = tiny(5 * 3600);
  const testing::TracerProgram program(campaign, 2);
  ASSERT_EQ(program.run(), 0) << program.failure();
  check_ledger(program, campaign);
}

}  // namespace
}  // namespace cupola
