#include "orchestrator/study/pareto.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace cupola {
namespace {

constexpr double smallest = 1e-16;  // an error of nothing has no logarithm
constexpr double clearly_below = 0.02;

double logarithm(double value) { return std::log(std::max(value, smallest)); }

}  // namespace

std::vector<std::size_t> pareto_front(const std::vector<CostAndError>& points) {
  std::vector<std::size_t> order(points.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
    return points[a].cost != points[b].cost ? points[a].cost < points[b].cost : points[a].error < points[b].error;
  });
  std::vector<std::size_t> front;
  for (const std::size_t i : order)
    if (front.empty() || points[i].error < points[front.back()].error) front.push_back(i);
  return front;
}

std::optional<std::size_t> knee_of(const std::vector<CostAndError>& points, const std::vector<std::size_t>& front) {
  if (front.size() < 3) return std::nullopt;
  const CostAndError &first = points[front.front()], &last = points[front.back()];
  const double wide = logarithm(last.cost) - logarithm(first.cost);
  const double high = logarithm(first.error) - logarithm(last.error);
  if (wide <= 0 || high <= 0) return std::nullopt;
  std::optional<std::size_t> knee;
  double farthest = clearly_below;
  for (const std::size_t i : front) {
    // Scaled to [0, 1] the chord runs from (0, 1) to (1, 0): x + y = 1.
    const double x = (logarithm(points[i].cost) - logarithm(first.cost)) / wide;
    const double y = (logarithm(points[i].error) - logarithm(last.error)) / high;
    if (1 - x - y > farthest) {
      farthest = 1 - x - y;
      knee = i;
    }
  }
  return knee;
}

}  // namespace cupola
