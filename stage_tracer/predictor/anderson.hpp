#pragma once
#include <deque>
#include <vector>

namespace cupola {

/// Anderson's acceleration of a fixed-point iteration x <- x + r(x) (type II): the next x is the combination of the
/// last ones whose residuals combine to the smallest.
class Anderson {
 public:
  /// @param weight of each unknown in the residual's norm
  Anderson(std::size_t depth, std::vector<double> weight) : depth_(depth), weight_(std::move(weight)) {}

  /// @return the next x
  std::vector<double> next(const std::vector<double>& x, const std::vector<double>& residual);

 private:
  std::size_t depth_;
  std::vector<double> weight_;
  std::vector<double> last_x_, last_residual_;
  std::deque<std::vector<double>> x_steps_, residual_steps_;
};

}  // namespace cupola
