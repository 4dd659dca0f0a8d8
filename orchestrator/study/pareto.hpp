#pragma once
#include <optional>
#include <string>
#include <vector>

namespace cupola {

/// A setting as a point: what it costs and how wrong it is.
struct CostAndError {
  double cost = 0;
  double error = 0;
};

/// Settings that no other one beats in both, by rising cost. @return indices into `points`
std::vector<std::size_t> pareto_front(const std::vector<CostAndError>& points);

/// The setting on the front's knee: the one that lies farthest below the chord between the front's ends, both axes
/// logarithmic and scaled to the front's extent.  None where the front has fewer than three points or none lies below
/// the chord: then every factor of time buys the same factor of error.
std::optional<std::size_t> knee_of(const std::vector<CostAndError>& points, const std::vector<std::size_t>& front);

}  // namespace cupola
