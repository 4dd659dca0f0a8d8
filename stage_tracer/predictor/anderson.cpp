#include "stage_tracer/predictor/anderson.hpp"

#include <algorithm>
#include <cmath>

#include "physics/plan/small_linear_system.hpp"

namespace cupola {
namespace {

constexpr double regularity = 1e-9;

}  // namespace

std::vector<double> Anderson::next(const std::vector<double>& x, const std::vector<double>& residual) {
  const std::size_t n = x.size();
  if (!last_x_.empty()) {
    std::vector<double> x_step(n);
    std::vector<double> residual_step(n);
    for (std::size_t i = 0; i < n; ++i) {
      x_step[i] = x[i] - last_x_[i];
      residual_step[i] = residual[i] - last_residual_[i];
    }
    x_steps_.push_back(std::move(x_step));
    residual_steps_.push_back(std::move(residual_step));
    if (x_steps_.size() > depth_) {
      x_steps_.pop_front();
      residual_steps_.pop_front();
    }
  }
  last_x_ = x;
  last_residual_ = residual;
  std::vector<double> result(n);
  for (std::size_t i = 0; i < n; ++i) result[i] = x[i] + residual[i];
  const std::size_t steps = x_steps_.size();
  if (steps == 0) return result;
  // Normal equations, scaled to a unit diagonal and kept regular by a little added to it: what that loses in accuracy
  // the next step makes good.
  const auto product = [this](const std::vector<double>& a, const std::vector<double>& b) {
    double sum = 0;
    for (std::size_t i = 0; i < a.size(); ++i) sum += weight_[i] * a[i] * b[i];
    return sum;
  };
  std::vector<double> length(steps);
  for (std::size_t i = 0; i < steps; ++i)
    length[i] = std::max(1e-300, std::sqrt(product(residual_steps_[i], residual_steps_[i])));
  SmallLinearSystem system(steps, 1);
  for (std::size_t i = 0; i < steps; ++i) {
    system.matrix(i, i) = 1 + regularity;
    for (std::size_t j = 0; j < i; ++j) {
      system.matrix(i, j) = system.matrix(j, i) =
          product(residual_steps_[i], residual_steps_[j]) / (length[i] * length[j]);
    }
    system.right(i, 0) = product(residual_steps_[i], residual) / length[i];
  }
  system.solve();
  for (std::size_t k = 0; k < steps; ++k) {
    const double weight = system.right(k, 0) / length[k];
    for (std::size_t i = 0; i < n; ++i) result[i] -= weight * (x_steps_[k][i] + residual_steps_[k][i]);
  }
  return result;
}

}  // namespace cupola
