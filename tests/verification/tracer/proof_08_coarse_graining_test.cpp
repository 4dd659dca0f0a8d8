#include <gtest/gtest.h>

#include <cstdio>

#include "tests/support/tracer_program.hpp"
#include "tests/verification/tracer/column.hpp"

namespace cupola {
namespace {

constexpr double solids_fraction = 0.55;

/// A column of two kinds of grain, in layers, whose parcels stand for n^3 grains.
Campaign coarse_grained(double n) {
  Campaign campaign = testing::column_campaign(10);
  campaign.species[0].conductivity = 10;
  testing::add_fine_grains(campaign, 3e-3, 40);
  campaign.charging.layers = {{{"pebble", 10}}, {{"fine", 10}}};
  campaign.charging.rings.clear();
  for (Species& species : campaign.species) species.coarse_graining = n;
  campaign.tracer.duration = 100;
  campaign.tracer.time_step = 10;
  return campaign;
}

/// Both species in every cell: what a cell holds is the same for any size of the parcels that it came in.
testing::StatedBed mixture(const BedMesh& mesh, const Campaign& campaign) {
  testing::StatedBed bed = testing::bed_at_rest(mesh, campaign, solids_fraction);
  const std::size_t parcels = bed.id.size();
  for (std::size_t p = 0; p < parcels; ++p) {
    bed.mass[p] *= 0.6;
    bed.add_parcel(1, bed.position[p], bed.radius[p], bed.mass[p] * 0.4 / 0.6);
  }
  return bed;
}

/// What a bed takes and resists as a whole.
struct BulkRates {
  double pressure_drop, heat_from_gas, heat_of_pebble, heat_of_fine;
};

BulkRates bulk_rates(testing::TracerProgram& program, const Campaign& campaign) {
  program.march_anew(campaign, mixture(program.mesh(), campaign));
  EXPECT_EQ(program.run(), 0) << program.failure();
  const nlohmann::json summary = program.result().summary();
  BulkRates rates{};
  rates.pressure_drop = summary["inlets"][0]["pressure"].get<double>() - campaign.scene.gas->outlet_pressure;
  rates.heat_from_gas = summary["ledger"]["energy"]["to_solids"].get<double>();
  const testing::FinalTracers tracers = program.tracers();
  for (std::size_t i = 0; i < tracers.id.size(); ++i) {
    const Species& species = campaign.species[static_cast<std::size_t>(tracers.species[i])];
    const double heat =
        tracers.volume[i] * species.density * species.heat_capacity.at(300) * (tracers.temperature[i] - 300);
    (tracers.species[i] == 0 ? rates.heat_of_pebble : rates.heat_of_fine) += heat;
  }
  return rates;
}

class EveryDragLaw : public ::testing::TestWithParam<DragLaw> {};

TEST_P(EveryDragLaw, SameBulkRatesForAnyCoarseGraining) {
  // Few transfer units, so that gas and solids vary little along the kernel of a parcel, which grows with it.
  const auto campaign_of = [](double n) {
    Campaign campaign = coarse_grained(n);
    campaign.drag = GetParam();
    campaign.heat->nusselt_factor = 0.01;
    return campaign;
  };
  testing::TracerProgram program(campaign_of(1), mixture);
  const BulkRates grains = bulk_rates(program, campaign_of(1));
  // The fines are heated faster and give some of it to the pebbles, through the faces of the layers.
  EXPECT_GT(grains.heat_of_fine, grains.heat_of_pebble * 0.4 / 0.6);
  for (const double n : {2.0, 4.0, 8.0}) {
    const BulkRates parcels = bulk_rates(program, campaign_of(n));
    std::printf(
        "n = %g: pressure drop %.3g, heat from the gas %.3g, of pebbles %.3g, of fines %.3g (relative change)\n", n,
        parcels.pressure_drop / grains.pressure_drop - 1, parcels.heat_from_gas / grains.heat_from_gas - 1,
        parcels.heat_of_pebble / grains.heat_of_pebble - 1, parcels.heat_of_fine / grains.heat_of_fine - 1);
    EXPECT_NEAR(parcels.pressure_drop, grains.pressure_drop, 1e-6 * grains.pressure_drop);
    EXPECT_NEAR(parcels.heat_from_gas, grains.heat_from_gas, 1e-3 * grains.heat_from_gas);
    EXPECT_NEAR(parcels.heat_of_pebble, grains.heat_of_pebble, 1e-3 * grains.heat_of_pebble);
    EXPECT_NEAR(parcels.heat_of_fine, grains.heat_of_fine, 1e-3 * grains.heat_of_fine);
  }
}

INSTANTIATE_TEST_SUITE_P(DragLaws, EveryDragLaw,
                         ::testing::Values(DragLaw::ergun, DragLaw::gidaspow, DragLaw::beetstra),
                         [](const auto& law) { return std::to_string(static_cast<int>(law.param)); });

}  // namespace
}  // namespace cupola
