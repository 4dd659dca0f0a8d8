#pragma once
#include <cstdint>
#include <vector>

#include "physics/mesh/bed_mesh.hpp"

namespace cupola {

/// A linear system with a few unknowns a cell (gas and species), each coupled to the same unknown of the six neighbours
/// and densely to the others of its own cell:
///   (A x)_c = D_c x_c - sum over sides of a_(c,side) * x_neighbour       (* component by component).
/// Vectors are [cell x fields + field].
class CounterFlowMatrix {
 public:
  CounterFlowMatrix(const BedMesh& mesh, std::size_t fields);

  double& diagonal(std::size_t cell, std::size_t row, std::size_t column) {
    return diagonal_[(cell * fields_ + row) * fields_ + column];
  }
  /// a >= 0, the coefficient of the neighbour's value.
  double& beside(std::size_t cell, std::size_t side, std::size_t field) {
    return beside_[(cell * 6 + side) * fields_ + field];
  }

  [[nodiscard]] std::vector<double> apply(const std::vector<double>& x) const;

  /// Incomplete factorisation without fill, the cells from the highest to the lowest: dense in the unknowns of a cell,
  /// so that on a single column of cells, whatever flows up or down in it, it is exact.
  /// @throws Failure diverged where a pivot is singular
  void factorise();
  /// Solves the factorised system in place.
  void precondition(std::vector<double>& x) const;

  struct Solution {
    int iterations = 0;
    double reduction = 1;  ///< |r|/|b|
  };
  /// Stabilised bi-conjugate gradients with the factorisation, from x = 0.
  Solution solve(const std::vector<double>& b, std::vector<double>& x, double reduction, int most_iterations) const;

 private:
  std::size_t cells_;
  std::size_t fields_;
  std::vector<std::int32_t> neighbour_;  ///< [6 cell + side], -1: none
  std::vector<std::int32_t> order_;      ///< cells from the top
  std::vector<std::int32_t> rank_;       ///< place of each cell in that order
  std::vector<double> diagonal_;
  std::vector<double> beside_;
  std::vector<double> inverse_;  ///< of the pivots, after factorise()
};

}  // namespace cupola
