#pragma once
#include <algorithm>
#include <array>
#include <cstddef>
#include <utility>
#include <vector>

namespace cupola {

/// A property over the temperature: straight lines between points, constant beyond the first and the last.  One point:
/// a constant.
class PropertyCurve {
 public:
  using Point = std::array<double, 2>;  ///< temperature in K, value

  PropertyCurve() : PropertyCurve(0) {}
  /// NOLINTNEXTLINE(google-explicit-constructor): a number is a constant property
  PropertyCurve(double constant) : points_{{0, constant}} {}
  /// @param points at least one, temperatures rising
  explicit PropertyCurve(std::vector<Point> points) : points_(std::move(points)) {}

  [[nodiscard]] bool is_constant() const { return points_.size() == 1; }
  [[nodiscard]] const std::vector<Point>& points() const { return points_; }

  [[nodiscard]] double at(double temperature) const {
    return is_constant() ? points_.front()[1] : interpolated(temperature);
  }
  /// Exact integral over the temperature, from one to the other (negative where the second is lower).
  [[nodiscard]] double integral(double from, double to) const {
    return is_constant() ? points_.front()[1] * (to - from) : from_first(to) - from_first(from);
  }
  /// Mean between two temperatures; the value where they are equal.
  [[nodiscard]] double mean(double from, double to) const {
    return from == to ? at(from) : integral(from, to) / (to - from);
  }

 private:
  [[nodiscard]] double interpolated(double temperature) const {
    const auto above = std::upper_bound(points_.begin(), points_.end(), temperature,
                                        [](double wanted, const Point& point) { return wanted < point[0]; });
    if (above == points_.begin()) return points_.front()[1];
    if (above == points_.end()) return points_.back()[1];
    const Point& below = *(above - 1);
    return below[1] + (temperature - below[0]) / ((*above)[0] - below[0]) * ((*above)[1] - below[1]);
  }
  /// Integral from the first point's temperature.
  [[nodiscard]] double from_first(double temperature) const {
    const Point& first = points_.front();
    if (temperature <= first[0]) return first[1] * (temperature - first[0]);
    double sum = 0;
    for (std::size_t i = 1; i < points_.size(); ++i) {
      const Point& before = points_[i - 1];
      const double end = std::min(temperature, points_[i][0]);
      sum += (end - before[0]) * (before[1] + interpolated(end)) / 2;
      if (temperature <= points_[i][0]) return sum;
    }
    return sum + points_.back()[1] * (temperature - points_.back()[0]);
  }

  std::vector<Point> points_;
};

}  // namespace cupola
