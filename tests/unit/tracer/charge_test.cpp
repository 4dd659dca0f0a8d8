#include <gtest/gtest.h>

#include <cmath>
#include <map>

#include "schemas/failure.hpp"
#include "stage_tracer/charge_plan.hpp"
#include "stage_tracer/insertion.hpp"
#include "tests/support/box_mesh.hpp"
#include "tests/support/furnaces.hpp"

namespace cupola {
namespace {

/// Two layers: 0.3 m3 of coke, then 0.1 m3 of ore mixed with 0.1 m3 of coke.
Campaign two_layers() {
  Campaign campaign = furnaces::shaft();
  campaign.charging.layers = {{{"coke", 240.0}}, {{"coke", 80.0}, {"ore", 300.0}}};
  return campaign;
}

TEST(ChargePlan, PiecesCoverTheIntervalAndCarryTheRecipe) {
  const ChargePlan plan(two_layers(), 0.01, 0.25);  // the first layer has 5 s to go, then 20 s, 30 s, 20 s, …
  EXPECT_DOUBLE_EQ(plan.cycle_seconds(), 50);
  EXPECT_DOUBLE_EQ(plan.thinnest_layer_seconds(), 20);
  const auto pieces = plan.pieces(0, 70);
  ASSERT_EQ(pieces.size(), 4U);
  EXPECT_NEAR(pieces[0].to, 5, 1e-12);
  EXPECT_NEAR(pieces[1].to, 25, 1e-12);
  EXPECT_NEAR(pieces[2].to, 55, 1e-12);
  double time = 0;
  std::vector<double> volume(2, 0.0);
  for (const auto& piece : pieces) {
    EXPECT_DOUBLE_EQ(piece.from, time);
    time = piece.to;
    for (std::size_t s = 0; s < 2; ++s) volume[s] += (*piece.share)[s] * (piece.to - piece.from) * plan.volume_rate();
  }
  EXPECT_DOUBLE_EQ(time, 70);
  EXPECT_NEAR(volume[0], 0.05 + 0.1 + 0.3 + 0.075, 1e-12);
  EXPECT_NEAR(volume[1], 0.1 + 0.075, 1e-12);
}

TEST(ChargePlan, PositionMayBeNegativeOrManyCyclesOn) {
  const ChargePlan before(two_layers(), 0.01, -0.1);
  const ChargePlan after(two_layers(), 0.01, 0.4 + 7 * 0.5);
  EXPECT_EQ(before.pieces(0, 1).front().layer, 1U);
  EXPECT_EQ(after.pieces(0, 1).front().layer, 1U);
  EXPECT_NEAR(before.pieces(0, 100).front().to, after.pieces(0, 100).front().to, 1e-9);
}

TEST(ChargePlan, RefusesAnEmptyRecipe) {
  Campaign campaign = furnaces::shaft();
  campaign.charging.layers.clear();
  EXPECT_THROW(ChargePlan(campaign, 0.01, 0), Failure);
}

/// Three places: the middle, a ring, the wall; the second layer lies in the ring alone.
TEST(ChargePlan, RingsKeepTheMassOfEachLayerAndTheFlowOfEachPlace) {
  Campaign campaign = two_layers();
  campaign.charging.rings = {std::nullopt, std::array<double, 2>{0.5, 1.0}};
  const std::vector<ChargePlan::Place> places = {{0.2, 0.004}, {0.7, 0.0045}, {0.8, 0.0005}, {1.1, 0.001}};
  const ChargePlan plan(campaign, 0.01, 0, places);
  EXPECT_EQ(plan.zones(), 2U);  // in the ring or not
  EXPECT_EQ(plan.zone_of_place(), (std::vector<std::size_t>{0, 1, 1, 0}));
  EXPECT_DOUBLE_EQ(plan.cycle_seconds(), 50);
  std::vector<double> layer(2, 0.0);
  for (std::size_t place = 0; place < places.size(); ++place) {
    const std::size_t zone = plan.zone_of_place()[place];
    double seconds = 0;
    for (const auto& piece : plan.pieces(0, 50, zone)) {
      layer[piece.layer] += places[place].volume_rate * (piece.to - piece.from);
      seconds += piece.to - piece.from;
      if (zone == 0) {
        EXPECT_EQ(piece.layer, 0U);
      }
    }
    EXPECT_NEAR(seconds, 50, 1e-9);  // a place is never idle: the surface stays level
  }
  EXPECT_NEAR(layer[0], 0.3, 1e-9);
  EXPECT_NEAR(layer[1], 0.2, 1e-9);
}

TEST(ChargePlan, RefusesARingThatCannotTakeItsLayerAndOneWithoutAPlace) {
  Campaign campaign = two_layers();
  campaign.charging.rings = {std::nullopt, std::array<double, 2>{0.5, 1.0}};
  // The second layer is two fifths of the charge, the ring takes only a tenth of the flow.
  EXPECT_THROW(ChargePlan(campaign, 0.01, 0, {{0.2, 0.009}, {0.7, 0.001}}), Failure);
  EXPECT_THROW(ChargePlan(campaign, 0.01, 0, {{0.2, 0.009}, {1.2, 0.001}}), Failure);
}

class InsertionTest : public ::testing::Test {
 protected:
  InsertionTest() : mesh_(make_mesh()), plan_(two_layers(), 0.01, 0) {
    // The four top faces with unequal shares of the flow.
    for (std::int64_t cell = 0; cell < static_cast<std::int64_t>(mesh_.cells()); ++cell) {
      const std::int64_t top = mesh_.cell_faces[cell][5];
      if (mesh_.face_neighbour[top] >= 0) continue;
      faces_.push_back({top, cell, 0.001 * static_cast<double>(faces_.size() + 1)});
    }
  }
  static BedMesh make_mesh() {
    testing::BoxMesh box;
    box.cells = {2, 2, 2};
    return box.make();
  }

  BedMesh mesh_;
  ChargePlan plan_;
  std::vector<StockFace> faces_;
  std::vector<double> tracer_volume_{7e-5, 3e-5};
};

TEST_F(InsertionTest, ChargedVolumeFollowsTheFluxOfEachFace) {
  Insertion insertion(mesh_, faces_, plan_, tracer_volume_, 1, 1000);
  const std::vector<double> owed_before = insertion.state().owed;
  std::map<std::pair<std::int64_t, int>, double> charged;
  const double duration = 1234;
  for (const Entry& entry : insertion.advance(0, duration)) {
    EXPECT_GE(entry.time, 0);
    EXPECT_LE(entry.time, duration);
    EXPECT_DOUBLE_EQ(entry.point.reference[2], 1);
    charged[{entry.point.cell, entry.species}] += entry.volume;
  }
  for (std::size_t f = 0; f < faces_.size(); ++f) {
    std::vector<double> due(2, 0.0);
    for (const auto& piece : plan_.pieces(0, duration)) {
      for (std::size_t s = 0; s < 2; ++s) due[s] += faces_[f].volume_rate * (*piece.share)[s] * (piece.to - piece.from);
    }
    for (std::size_t s = 0; s < 2; ++s) {
      const double stored = insertion.state().owed[f * 2 + s] - owed_before[f * 2 + s];
      const double entered = charged[{faces_[f].cell, static_cast<int>(s)}];
      EXPECT_NEAR(entered + stored, due[s], 1e-10) << "face " << f << " species " << s;
      EXPECT_LT(std::abs(stored), tracer_volume_[s]);
    }
  }
}

TEST_F(InsertionTest, EntryTimesDoNotDependOnTheSteps) {
  Insertion in_one(mesh_, faces_, plan_, tracer_volume_, 1, 1000);
  Insertion in_many(mesh_, faces_, plan_, tracer_volume_, 1, 1000);
  std::map<std::int64_t, double> one;
  std::map<std::int64_t, double> many;
  for (const Entry& e : in_one.advance(0, 100)) one.emplace(e.id, e.time);
  for (int k = 0; k < 40; ++k) {
    for (const Entry& e : in_many.advance(2.5 * k, 2.5 * (k + 1))) {
      many.emplace(e.id, e.time);
    }
  }
  ASSERT_EQ(one.size(), many.size());
  ASSERT_GT(one.size(), 1000U);
  for (auto a = one.begin(), b = many.begin(); a != one.end(); ++a, ++b) {
    EXPECT_EQ(a->first, b->first);
    EXPECT_NEAR(a->second, b->second, 1e-8);
  }
  EXPECT_EQ(in_one.state().entered, in_many.state().entered);
}

}  // namespace
}  // namespace cupola
