#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <functional>
#include <iostream>

#include "tests/support/stated_bed.hpp"
#include "tests/support/tracer_program.hpp"
#include "tests/verification/tracer/column.hpp"

/// The tracer stage on a column of pebbles at rest, blown from below, with one thing of the bed, of the tracers or of
/// the march taken to its extreme.  The bed of 300 K cannot leave the range of itself and the blast, and the balances
/// must close; or it is refused with a sentence that names the limit.  Tests named Long… run in `make test-long` alone.
/// Each prints a row of the table in docs/stability.md.
namespace cupola::testing {
namespace {

struct Column {
  Column(std::string its_name, std::string what_is_extreme, int its_rows = 20)
      : name(std::move(its_name)), what(std::move(what_is_extreme)), rows(its_rows) {}
  std::string name;
  std::string what;
  int rows;
  std::function<void(Campaign&)> change = [](Campaign&) {};
  std::function<StatedBed(const BedMesh&, const Campaign&)> bed = [](const BedMesh& mesh, const Campaign& campaign) {
    return bed_at_rest(mesh, campaign, 0.6);
  };
  std::string refusal;  ///< part of the sentence; empty: it must end well
  std::function<std::string(const nlohmann::json&)> demand = [](const nlohmann::json&) { return std::string(); };
};

/// The solids of cells whose centre fulfils a condition.
StatedBed bed_where(const BedMesh& mesh, const Campaign& campaign, double fraction,
                    const std::function<bool(const Vector3&)>& here) {
  StatedBed all = bed_at_rest(mesh, campaign, fraction), some;
  some.solids_fraction.assign(mesh.cells(), 0.0);
  some.solids_velocity = all.solids_velocity;
  for (std::size_t i = 0; i < all.position.size(); ++i)
    if (here(all.position[i])) some.add_parcel(all.species[i], all.position[i], all.radius[i], all.mass[i]);
  for (std::size_t cell = 0; cell < mesh.cells(); ++cell)
    if (here(mesh.cell_centre[cell])) some.solids_fraction[cell] = all.solids_fraction[cell];
  return some;
}

std::function<std::string(const nlohmann::json&)> at_least(const std::string& pointer, double wanted) {
  return [=](const nlohmann::json& summary) {
    const double found = summary.value(nlohmann::json::json_pointer(pointer), -1.);
    EXPECT_GE(found, wanted) << pointer;
    return fmt::format("{:.3g} {}", found, pointer.substr(pointer.rfind('/') + 1));
  };
}

Column tracers(const std::string& name, const std::string& what, int rows, double wanted) {
  Column column{name, what, rows};
  column.change = [](Campaign& c) {
    c.tracer.tracers_per_cell = 1000;
    c.tracer.duration = 5;
  };
  column.demand = at_least("/tracers", wanted);
  return column;
}

Column march(const std::string& name, const std::string& what, double step, double wanted) {
  Column column{name, what, 5};
  column.change = [=](Campaign& c) { c.tracer.time_step = step; };
  column.demand = at_least("/steps", wanted);
  return column;
}

std::vector<Column> columns() {
  std::vector<Column> all;
  Column dense{"VoidFractionTiny", "void fraction 0.05"};
  dense.bed = [](const BedMesh& mesh, const Campaign& c) { return bed_at_rest(mesh, c, 0.95); };
  all.push_back(dense);
  Column gap{"VoidFractionOne", "void fraction 1 in the middle third of the bed"};
  gap.bed = [](const BedMesh& mesh, const Campaign& c) {
    return bed_where(mesh, c, 0.6, [](const Vector3& r) { return std::abs(r[2] - 0.5) > 1.0 / 6; });
  };
  all.push_back(gap);
  Column nothing{"NoTracer", "no tracer at all"};
  nothing.bed = [](const BedMesh& mesh, const Campaign& c) {
    return bed_where(mesh, c, 0.6, [](const Vector3&) { return false; });
  };
  nothing.refusal = "holds no parcel";
  all.push_back(nothing);
  Column one{"OneTracer", "one tracer in the whole bed"};
  one.change = [](Campaign& c) { c.tracer.tracers_per_cell = 1e-3; };
  one.bed = [](const BedMesh& mesh, const Campaign& c) {
    StatedBed bed = bed_at_rest(mesh, c, 0.6);
    for (auto* numbers : {&bed.id, &bed.species}) numbers->resize(1);
    for (auto* numbers : {&bed.radius, &bed.mass}) numbers->resize(1);
    bed.position.resize(1);
    return bed;
  };
  one.demand = [](const nlohmann::json& summary) {
    EXPECT_EQ(summary.value("tracers", 0), 1);
    return fmt::format("{} tracer", summary.value("tracers", 0));
  };
  all.push_back(one);
  all.push_back(tracers("HundredThousandTracers", "10^5 tracers, 1,000 a cell", 51, 1e5));
  all.push_back(tracers("LongMillionTracers", "10^6 tracers, 1,000 a cell", 505, 1e6));
  all.push_back(march("TenThousandSteps", "a stage of 10^4 steps", 0.01, 1e4));
  all.push_back(march("LongHundredThousandSteps", "a stage of 10^5 steps", 0.001, 1e5));
  Column wide{"ParcelsWiderThanCells", "parcels of 0.25 m in cells of 0.05 m", 20};
  wide.change = [](Campaign& c) {
    c.scene.geometry.sides = Geometry::Sides::walls;
    c.species[0].coarse_graining = 50;
  };
  all.push_back(wide);
  Column thick{"BiotNumberHuge", "Biot number above 100, with the resistance inside the grains"};
  thick.change = [](Campaign& c) {
    c.species[0].conductivity = 3e-4;
    c.heat->intragrain_resistance = true;
  };
  thick.demand = at_least("/biot_largest/pebble", 100);
  all.push_back(thick);
  return all;
}

class ColumnExtremes : public ::testing::TestWithParam<Column> {};

TEST_P(ColumnExtremes, EndsWellOrIsRefused) {
  const Column& column = GetParam();
  Campaign campaign = column_campaign(column.rows);
  column.change(campaign);
  const auto begin = std::chrono::steady_clock::now();
  const TracerProgram program(campaign, column.bed);
  const int status = program.run();
  const double seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
  if (!column.refusal.empty()) {
    EXPECT_TRUE(status == 65 || status == 70) << status;
    EXPECT_NE(program.failure().find(column.refusal), std::string::npos) << program.failure();
    std::cout << fmt::format("| tracer | {} | refused: \"... {} ...\" | | | {:.1f} |\n", column.what, column.refusal,
                             seconds);
    return;
  }
  ASSERT_EQ(status, 0) << program.failure();
  const FieldFile result = program.result();
  const nlohmann::json summary = result.summary();
  const double mass = summary["ledger"]["mass"]["residual"], energy = summary["ledger"]["energy"]["residual"];
  EXPECT_LT(std::abs(mass), 1e-10);
  EXPECT_LT(std::abs(energy), 1e-3);
  double least = HUGE_VAL, most = 0;
  for (const char* field : {"solids_temperature", "gas_temperature"})
    for (const double value : result.cell_data(field)) {
      ASSERT_TRUE(std::isfinite(value)) << field;
      least = std::min(least, value);
      most = std::max(most, value);
    }
  EXPECT_GT(least, 293 - 0.5);
  EXPECT_LT(most, campaign.scene.gas->inlets[0].total_temperature + 0.5);
  const std::string more = column.demand(summary);
  std::cout << fmt::format(
      "| tracer | {} | stable, {:.0f} to {:.0f} K | mass {:.1g}, energy {:.1g}{} | {} | {:.1f} |\n", column.what, least,
      most, mass, energy, more.empty() ? "" : "; " + more, summary["steps"].get<long>(), seconds);
}

INSTANTIATE_TEST_SUITE_P(Stage, ColumnExtremes, ::testing::ValuesIn(columns()),
                         [](const auto& info) { return info.param.name; });

}  // namespace
}  // namespace cupola::testing
