#include "stage_tracer/predictor/counter_flow_matrix.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "tests/support/box_mesh.hpp"

namespace cupola {
namespace {

/// Gas up and two kinds of solids down in every column, with some gas across.
CounterFlowMatrix counter_flow(const BedMesh& mesh, double across) {
  CounterFlowMatrix matrix(mesh, 3);
  const double exchange[] = {0, 0.7, 1.9};
  const double carried[] = {2.0 + 2 * across, 1.1, 1.6};
  for (std::size_t c = 0; c < mesh.cells(); ++c) {
    for (std::size_t i = 0; i < 3; ++i) {
      matrix.diagonal(c, i, i) += carried[i] + exchange[i];
      matrix.beside(c, i == 0 ? 4 : 5, i) += i == 0 ? 2.0 : carried[i];
      if (i == 0) continue;
      matrix.diagonal(c, 0, 0) += exchange[i];
      matrix.diagonal(c, 0, i) -= exchange[i];
      matrix.diagonal(c, i, 0) -= exchange[i];
    }
    matrix.beside(c, 0, 0) += across;
    matrix.beside(c, 1, 0) += across;
  }
  return matrix;
}

std::vector<double> some_values(std::size_t n) {
  std::vector<double> x(n);
  for (std::size_t i = 0; i < n; ++i) x[i] = 300 + 50 * std::sin(1.7 * static_cast<double>(i));
  return x;
}

TEST(CounterFlowMatrix, ColumnsAreSolvedExactlyByTheFactorisation) {
  const BedMesh mesh = testing::BoxMesh{{2, 2, 40}}.make();
  CounterFlowMatrix matrix = counter_flow(mesh, 0);
  matrix.factorise();
  const std::vector<double> exact = some_values(3 * mesh.cells());
  std::vector<double> x = matrix.apply(exact);
  matrix.precondition(x);
  for (std::size_t i = 0; i < x.size(); ++i) ASSERT_NEAR(x[i], exact[i], 1e-9) << i;
}

TEST(CounterFlowMatrix, IterationsSolveWhatIsCoupledAcross) {
  const BedMesh mesh = testing::BoxMesh{{6, 3, 30}}.make();
  CounterFlowMatrix matrix = counter_flow(mesh, 0.4);
  matrix.factorise();
  const std::vector<double> exact = some_values(3 * mesh.cells());
  std::vector<double> x;
  const auto solution = matrix.solve(matrix.apply(exact), x, 1e-10, 100);
  EXPECT_LT(solution.iterations, 25);
  for (std::size_t i = 0; i < x.size(); ++i) ASSERT_NEAR(x[i], exact[i], 1e-4) << i;
}

}  // namespace
}  // namespace cupola
