#pragma once
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <vector>

namespace cupola {

/// A dense system of a few unknowns with several right-hand sides, solved in place by elimination with row pivoting.
class SmallLinearSystem {
 public:
  SmallLinearSystem(std::size_t unknowns, std::size_t right_hand_sides)
      : size_(unknowns), width_(unknowns + right_hand_sides), values_(unknowns * width_, 0) {}

  void clear() { std::fill(values_.begin(), values_.end(), 0); }
  double& matrix(std::size_t row, std::size_t column) { return values_[row * width_ + column]; }
  double& right(std::size_t row, std::size_t side) { return values_[row * width_ + size_ + side]; }

  /// Replaces the right-hand sides by the solutions; the matrix must be regular.
  void solve() {
    for (std::size_t pivot = 0; pivot < size_; ++pivot) {
      std::size_t largest = pivot;
      for (std::size_t row = pivot + 1; row < size_; ++row) {
        if (std::abs(matrix(row, pivot)) > std::abs(matrix(largest, pivot))) largest = row;
      }
      if (largest != pivot) {
        std::swap_ranges(&matrix(pivot, 0), &matrix(pivot, 0) + width_, &matrix(largest, 0));
      }
      for (std::size_t row = 0; row < size_; ++row) {
        if (row == pivot) continue;
        const double factor = matrix(row, pivot) / matrix(pivot, pivot);
        if (factor == 0) continue;
        for (std::size_t column = pivot; column < width_; ++column)
          matrix(row, column) -= factor * matrix(pivot, column);
      }
    }
    for (std::size_t row = 0; row < size_; ++row) {
      for (std::size_t column = size_; column < width_; ++column) values_[row * width_ + column] /= matrix(row, row);
    }
  }

 private:
  std::size_t size_, width_;
  std::vector<double> values_;
};

}  // namespace cupola
