#include "stage_tracer/predictor/counter_flow_matrix.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "physics/equations/cell_failure.hpp"

namespace cupola {
namespace {

/// Inverts a small dense matrix by Gauss-Jordan elimination; diagonally dominant, so that no pivoting is needed.
bool invert(std::size_t n, double* a, double* inverse) {
  for (std::size_t i = 0; i < n; ++i) {
    for (std::size_t j = 0; j < n; ++j) inverse[i * n + j] = i == j ? 1 : 0;
  }
  for (std::size_t k = 0; k < n; ++k) {
    const double pivot = a[k * n + k];
    if (!std::isnormal(pivot)) return false;
    for (std::size_t j = 0; j < n; ++j) {
      a[k * n + j] /= pivot;
      inverse[k * n + j] /= pivot;
    }
    for (std::size_t i = 0; i < n; ++i) {
      if (i == k) continue;
      const double factor = a[i * n + k];
      for (std::size_t j = 0; j < n; ++j) {
        a[i * n + j] -= factor * a[k * n + j];
        inverse[i * n + j] -= factor * inverse[k * n + j];
      }
    }
  }
  return true;
}

double dot(const std::vector<double>& a, const std::vector<double>& b) {
  return std::inner_product(a.begin(), a.end(), b.begin(), 0.0);
}

}  // namespace

CounterFlowMatrix::CounterFlowMatrix(const BedMesh& mesh, std::size_t fields)
    : cells_(mesh.cells()),
      fields_(fields),
      neighbour_(6 * cells_),
      order_(cells_),
      rank_(cells_),
      diagonal_(cells_ * fields * fields, 0.0),
      beside_(cells_ * 6 * fields, 0.0) {
  for (std::size_t c = 0; c < cells_; ++c) {
    for (std::size_t side = 0; side < 6; ++side) {
      const auto across = mesh.across(static_cast<std::int64_t>(c), mesh.cell_faces[c][side]);
      neighbour_[6 * c + side] = across == static_cast<std::int64_t>(c) ? -1 : static_cast<std::int32_t>(across);
    }
  }
  std::iota(order_.begin(), order_.end(), 0);
  std::stable_sort(order_.begin(), order_.end(),
                   [&](std::int32_t a, std::int32_t b) { return mesh.cell_centre[a][2] > mesh.cell_centre[b][2]; });
  for (std::size_t i = 0; i < cells_; ++i) rank_[order_[i]] = static_cast<std::int32_t>(i);
}

std::vector<double> CounterFlowMatrix::apply(const std::vector<double>& x) const {
  std::vector<double> result(x.size());
  for (std::size_t c = 0; c < cells_; ++c) {
    const double* own = &x[c * fields_];
    for (std::size_t i = 0; i < fields_; ++i) {
      double sum = 0;
      for (std::size_t j = 0; j < fields_; ++j) sum += diagonal_[(c * fields_ + i) * fields_ + j] * own[j];
      result[c * fields_ + i] = sum;
    }
    for (std::size_t side = 0; side < 6; ++side) {
      const std::int32_t n = neighbour_[6 * c + side];
      if (n < 0) continue;
      for (std::size_t i = 0; i < fields_; ++i)
        result[c * fields_ + i] -= beside_[(c * 6 + side) * fields_ + i] * x[n * fields_ + i];
    }
  }
  return result;
}

void CounterFlowMatrix::factorise() {
  const std::size_t block = fields_ * fields_;
  inverse_.resize(diagonal_.size());
  std::vector<double> pivot(block);
  for (const std::int32_t cell : order_) {
    const auto c = static_cast<std::size_t>(cell);
    std::copy_n(&diagonal_[c * block], block, pivot.begin());
    for (std::size_t side = 0; side < 6; ++side) {
      const std::int32_t n = neighbour_[6 * c + side];
      if (n < 0 || rank_[n] > rank_[c]) continue;
      // D_c - A_cn D_n^-1 A_nc; opposite sides share their number but for the last bit.
      const double* to = &beside_[(c * 6 + side) * fields_];
      const double* back = &beside_[(static_cast<std::size_t>(n) * 6 + (side ^ 1U)) * fields_];
      const double* between = &inverse_[static_cast<std::size_t>(n) * block];
      for (std::size_t i = 0; i < fields_; ++i) {
        for (std::size_t j = 0; j < fields_; ++j) pivot[i * fields_ + j] -= to[i] * between[i * fields_ + j] * back[j];
      }
    }
    if (!invert(fields_, pivot.data(), &inverse_[c * block])) {
      throw Failure(ExitCode::diverged,
                    "the temperatures of gas and solids are not tied to anything in cell " + std::to_string(c))
          .at("cell", std::to_string(c));
    }
  }
}

void CounterFlowMatrix::precondition(std::vector<double>& x) const {
  const std::size_t block = fields_ * fields_;
  std::vector<double> sum(fields_);
  const auto add_inverse_times_sum = [&](std::size_t c) {
    for (std::size_t i = 0; i < fields_; ++i) {
      double value = 0;
      for (std::size_t j = 0; j < fields_; ++j) value += inverse_[c * block + i * fields_ + j] * sum[j];
      x[c * fields_ + i] += value;
    }
  };
  for (const std::int32_t cell : order_) {
    const auto c = static_cast<std::size_t>(cell);
    for (std::size_t i = 0; i < fields_; ++i) sum[i] = std::exchange(x[c * fields_ + i], 0.0);
    for (std::size_t side = 0; side < 6; ++side) {
      const std::int32_t n = neighbour_[6 * c + side];
      if (n < 0 || rank_[n] > rank_[c]) continue;
      for (std::size_t i = 0; i < fields_; ++i) sum[i] += beside_[(c * 6 + side) * fields_ + i] * x[n * fields_ + i];
    }
    add_inverse_times_sum(c);
  }
  for (auto place = order_.rbegin(); place != order_.rend(); ++place) {
    const auto c = static_cast<std::size_t>(*place);
    std::fill(sum.begin(), sum.end(), 0.0);
    for (std::size_t side = 0; side < 6; ++side) {
      const std::int32_t n = neighbour_[6 * c + side];
      if (n < 0 || rank_[n] < rank_[c]) continue;
      for (std::size_t i = 0; i < fields_; ++i) sum[i] += beside_[(c * 6 + side) * fields_ + i] * x[n * fields_ + i];
    }
    add_inverse_times_sum(c);
  }
}

CounterFlowMatrix::Solution CounterFlowMatrix::solve(const std::vector<double>& b, std::vector<double>& x,
                                                     double reduction, int most_iterations) const {
  const std::size_t n = b.size();
  Solution solution;
  x.assign(n, 0.0);
  const double norm = std::sqrt(dot(b, b));
  if (!(norm > 0)) return {0, 0};
  std::vector<double> r = b;
  const std::vector<double> shadow = b;
  std::vector<double> p(n, 0.0);
  std::vector<double> v(n, 0.0);
  double rho = 1;
  double alpha = 1;
  double omega = 1;
  while (solution.iterations < most_iterations) {
    ++solution.iterations;
    const double next = dot(shadow, r);
    const double beta = next / rho * (alpha / omega);
    rho = next;
    for (std::size_t i = 0; i < n; ++i) p[i] = r[i] + beta * (p[i] - omega * v[i]);
    std::vector<double> y = p;
    precondition(y);
    v = apply(y);
    alpha = rho / dot(shadow, v);
    for (std::size_t i = 0; i < n; ++i) r[i] -= alpha * v[i];
    std::vector<double> z = r;
    precondition(z);
    const std::vector<double> t = apply(z);
    const double square = dot(t, t);
    omega = square > 0 ? dot(t, r) / square : 0;
    if (!std::isfinite(alpha) || !std::isfinite(omega)) break;
    for (std::size_t i = 0; i < n; ++i) {
      x[i] += alpha * y[i] + omega * z[i];
      r[i] -= omega * t[i];
    }
    solution.reduction = std::sqrt(dot(r, r)) / norm;
    if (solution.reduction <= reduction || omega == 0) break;
  }
  return solution;
}

}  // namespace cupola
