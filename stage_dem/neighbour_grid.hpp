#pragma once
#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <unordered_map>
#include <vector>

#include "schemas/campaign.hpp"

namespace cupola {

/// Spheres sorted into cubes, to find those near a point; y wraps with period `depth` (0: no wrap).
class NeighbourGrid {
 public:
  /// @param reach largest distance ever asked for, m: the cubes' edge
  NeighbourGrid(double reach, double depth)
      : reach_(reach),
        depth_(depth),
        slices_(depth > 0 ? std::max<std::int64_t>(1, std::llround(std::floor(depth / reach))) : 0) {}

  void add(const Vector3& position, std::size_t index) { cubes_[key(place(position))].push_back({position, index}); }

  /// Calls visit(index, vector from point to sphere's centre) for every sphere in the 27 cubes around the point; where
  /// the period holds fewer than three cubes, each is visited once.
  template <typename Visit>
  void near(const Vector3& point, Visit&& visit) const {
    const auto centre = place(point);
    const std::int64_t sideways = slices_ == 0 || slices_ >= 3 ? 1 : 0;
    for (std::int64_t i = -1; i <= 1; ++i)
      for (std::int64_t k = -1; k <= 1; ++k) {
        if (sideways == 1)
          for (std::int64_t j = -1; j <= 1; ++j)
            visit_cube({centre[0] + i, centre[1] + j, centre[2] + k}, point, visit);
        else
          for (std::int64_t j = 0; j < slices_; ++j) visit_cube({centre[0] + i, j, centre[2] + k}, point, visit);
      }
  }

  /// Shortest vector between two points, over the period.
  [[nodiscard]] Vector3 between(const Vector3& from, const Vector3& to) const {
    Vector3 way{to[0] - from[0], to[1] - from[1], to[2] - from[2]};
    if (depth_ > 0) way[1] -= depth_ * std::round(way[1] / depth_);
    return way;
  }

 private:
  struct Entry {
    Vector3 position;
    std::size_t index;
  };

  using Place = std::array<std::int64_t, 3>;

  [[nodiscard]] Place place(const Vector3& position) const {
    Place cube{static_cast<std::int64_t>(std::floor(position[0] / reach_)),
               static_cast<std::int64_t>(std::floor(position[1] / reach_)),
               static_cast<std::int64_t>(std::floor(position[2] / reach_))};
    if (slices_ > 0) {
      const double share = position[1] / depth_ - std::floor(position[1] / depth_);
      cube[1] = std::min(slices_ - 1, static_cast<std::int64_t>(share * static_cast<double>(slices_)));
    }
    return cube;
  }

  static std::uint64_t key(const Place& cube) {
    constexpr std::int64_t offset = 1 << 20;
    return (static_cast<std::uint64_t>(cube[0] + offset) << 42U) |
           (static_cast<std::uint64_t>(cube[1] + offset) << 21U) | static_cast<std::uint64_t>(cube[2] + offset);
  }

  template <typename Visit>
  void visit_cube(Place cube, const Vector3& point, Visit&& visit) const {
    if (slices_ > 0) cube[1] = (cube[1] + slices_) % slices_;
    const auto found = cubes_.find(key(cube));
    if (found == cubes_.end()) return;
    for (const auto& entry : found->second) visit(entry.index, between(point, entry.position));
  }

  double reach_;
  double depth_;
  std::int64_t slices_;
  std::unordered_map<std::uint64_t, std::vector<Entry>> cubes_;
};

}  // namespace cupola
