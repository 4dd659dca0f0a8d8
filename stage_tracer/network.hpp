#pragma once
#include <cstddef>
#include <vector>

namespace cupola {

/// A conductance between two nodes, W/K.
struct Link {
  std::size_t first, second;
  double conductance;
};

/// Solves the symmetric positive definite system
///   diagonal_i x_i + sum_links g (x_i - x_j) = source_i
/// by conjugate gradients with the diagonal as preconditioner, from the given x.
/// @param diagonal >= 0; a node with neither diagonal nor link keeps its x
/// @param tolerance largest preconditioned residual, in units of x
/// @return iterations  @throws Failure diverged when `most_iterations` do not suffice
int solve_network(const std::vector<Link>& links, const std::vector<double>& diagonal,
                  const std::vector<double>& source, std::vector<double>& x, double tolerance,
                  int most_iterations = 2000);

/// sum_links g (x_j - x_i): what flows into each node, W.
std::vector<double> network_inflow(const std::vector<Link>& links, const std::vector<double>& x);

}  // namespace cupola
