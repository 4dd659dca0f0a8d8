// The one-dimensional counter-current bed against exact solutions.
#include "physics/plan/counter_current_bed.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace cupola {
namespace {

constexpr double length = 8, gas_flow = 1500, solids_flow = 1100, conductance = 700, hot = 2600, cold = 293;

CounterCurrentBed one_kind(double gas, double solids, double per_metre) {
  CounterCurrentBed bed;
  bed.length = length;
  bed.gas_heat_capacity_flow = gas;
  bed.gas_enters_at = hot;
  bed.solids.push_back({solids, cold, std::nullopt, 0});
  bed.exchange = [=](double, const std::vector<bool>&) { return BedExchange{{per_metre}, 0, 0}; };
  return bed;
}

/// Exact gas and solids temperatures at a depth: the difference grows as exp(h (1/Cg - 1/Cs) s), the heat flow Cg Tg -
/// Cs Ts is the same at every depth.
struct Exact {
  double gas, solids;
};
Exact exact(double gas, double solids, double per_metre, double depth) {
  const double rate = per_metre * (1 / gas - 1 / solids);
  const double capacity_ratio = solids / gas;
  // Tg(s) - Ts(s) = d exp(rate s) = d + (ratio - 1) (Ts(s) - cold).
  const double grown = std::exp(rate * length);
  const double d = (hot - cold) * (1 - capacity_ratio) / (1 - capacity_ratio * grown);
  const double difference = d * std::exp(rate * depth);
  const double solids_temperature = cold + (difference - d) / (capacity_ratio - 1);
  return {solids_temperature + difference, solids_temperature};
}

double largest_error(int cells) {
  const auto solution = solve_counter_current_bed(one_kind(gas_flow, solids_flow, conductance), cells);
  double error = 0;
  for (std::size_t n = 0; n < solution.depth.size(); ++n) {
    const Exact reference = exact(gas_flow, solids_flow, conductance, solution.depth[n]);
    error = std::max(error, std::abs(solution.gas_temperature[n] - reference.gas));
    error = std::max(error, std::abs(solution.solids_temperature[0][n] - reference.solids));
  }
  return error;
}

TEST(CounterCurrentBed, ExactReferenceMeetsItsOwnBoundaryConditions) {
  EXPECT_NEAR(exact(gas_flow, solids_flow, conductance, 0).solids, cold, 1e-9);
  EXPECT_NEAR(exact(gas_flow, solids_flow, conductance, length).gas, hot, 1e-9);
}

TEST(CounterCurrentBed, ConvergesToTheExponentialProfileAtSecondOrder) {
  double coarse = largest_error(20);
  EXPECT_LT(coarse, 10);
  for (const int cells : {40, 80, 160, 320}) {
    const double fine = largest_error(cells);
    EXPECT_NEAR(std::log2(coarse / fine), 2, 0.05) << cells;
    coarse = fine;
  }
  EXPECT_LT(largest_error(0), 0.01);
}

TEST(CounterCurrentBed, BalancedFlowsGiveStraightLines) {
  const auto solution = solve_counter_current_bed(one_kind(1000, 1000, 500), 7);
  // Tg - Ts is constant, (hot - cold)/(1 + NTU); the trapezoidal rule is exact for it.
  const double difference = (hot - cold) / (1 + 500 * length / 1000);
  for (std::size_t n = 0; n < solution.depth.size(); ++n) {
    EXPECT_NEAR(solution.gas_temperature[n] - solution.solids_temperature[0][n], difference, 1e-9);
  }
}

TEST(CounterCurrentBed, StaysBoundedForManyTransferUnits) {
  // 400 transfer units: shooting from one end would lose all digits.
  for (const double solids : {900.0, 1100.0, 2000.0}) {
    const auto solution = solve_counter_current_bed(one_kind(1000, solids, 50000));
    for (std::size_t n = 0; n < solution.depth.size(); ++n) {
      EXPECT_GE(solution.gas_temperature[n], cold - 1e-6);
      EXPECT_LE(solution.gas_temperature[n], hot + 1e-6);
    }
    EXPECT_NEAR(solution.residual() / solution.gas_in, 0, 1e-12);
  }
}

TEST(CounterCurrentBed, WithoutSolidsTheWallCoolsTheGasExponentially) {
  CounterCurrentBed bed = one_kind(gas_flow, solids_flow, 0);
  bed.exchange = [](double, const std::vector<bool>&) { return BedExchange{{0}, 0, 120}; };
  const auto solution = solve_counter_current_bed(bed);
  EXPECT_NEAR(solution.gas_temperature.front(), 293 + (hot - 293) * std::exp(-120 * length / gas_flow), 1e-3);
  EXPECT_NEAR(solution.residual() / solution.gas_in, 0, 1e-12);
}

CounterCurrentBed furnace(double gas) {
  CounterCurrentBed bed;
  bed.length = length;
  bed.gas_heat_capacity_flow = gas;
  bed.gas_enters_at = hot;
  bed.solids = {{400, cold, std::nullopt, 0}, {1300, cold, 1675, 6.5}};
  bed.exchange = [](double depth, const std::vector<bool>& present) {
    const double wide = 1 + 0.05 * depth;
    return present[1] ? BedExchange{{180 * wide, 1200 * wide}, 60, 25} : BedExchange{{400 * wide, 0}, 0, 25};
  };
  return bed;
}

TEST(CounterCurrentBed, BalanceClosesToRoundOffWithMeltingLayersAndWall) {
  for (const double gas : {1000.0, 1800.0, 2600.0}) {
    const auto solution = solve_counter_current_bed(furnace(gas));
    EXPECT_NEAR(solution.residual() / solution.gas_in, 0, 1e-12);
    EXPECT_GT(solution.to_wall, 0);
  }
}

TEST(CounterCurrentBed, OreLeavesWhereItMelts) {
  const auto solution = solve_counter_current_bed(furnace(2200));
  ASSERT_TRUE(solution.melting_depth[1]);
  EXPECT_FALSE(solution.melting_depth[0]);
  const double end = *solution.melting_depth[1];
  EXPECT_GT(end, 0.5);
  EXPECT_LT(end, 6.5);
  EXPECT_NEAR(solution.solids_temperature[1].back(), 1675, 1e-6);
  EXPECT_NEAR(solution.to_solids[1], 1300 * (1675 - cold), 1e-3);
  // The depth does not depend on where the cells are.
  const auto other = solve_counter_current_bed(furnace(2200), 1777);
  EXPECT_NEAR(*other.melting_depth[1], end, 1e-3);
  const auto softens = solution.depth_of(1, 1475);
  ASSERT_TRUE(softens);
  EXPECT_LT(*softens, end);
}

TEST(CounterCurrentBed, MoreGasMeltsHigherAndTooLittleNever) {
  double before = 1e9;
  for (const double gas : {1900.0, 2200.0, 2600.0, 3200.0}) {
    const auto solution = solve_counter_current_bed(furnace(gas));
    ASSERT_TRUE(solution.melting_depth[1]) << gas;
    EXPECT_LT(*solution.melting_depth[1], before);
    before = *solution.melting_depth[1];
  }
  const auto weak = solve_counter_current_bed(furnace(800));
  EXPECT_FALSE(weak.melting_depth[1]);
  EXPECT_EQ(weak.end_depth[1], 6.5);
  EXPECT_LT(weak.solids_temperature[1].back(), 1675);
}

}  // namespace
}  // namespace cupola
