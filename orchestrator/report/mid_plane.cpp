#include "orchestrator/report/mid_plane.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace cupola {

namespace {

constexpr std::array<std::array<std::size_t, 2>, 12> edges{
    {{0, 1}, {1, 2}, {2, 3}, {3, 0}, {4, 5}, {5, 6}, {6, 7}, {7, 4}, {0, 4}, {1, 5}, {2, 6}, {3, 7}}};

/// Where the plane cuts the cell's edges, in order around their centre.
CutCell cut(std::size_t cell, const std::array<std::array<double, 3>, 8>& corners, double y) {
  CutCell result{cell, {}, {}};
  for (const auto& [from, to] : edges) {
    const auto& a = corners.at(from);
    const auto& b = corners.at(to);
    if ((a[1] < y) != (b[1] < y)) {
      const double share = (y - a[1]) / (b[1] - a[1]);
      result.corners.push_back({std::lerp(a[0], b[0], share), std::lerp(a[2], b[2], share)});
    }
  }
  for (const auto& corner : result.corners) {
    result.centre[0] += corner[0] / static_cast<double>(result.corners.size());
    result.centre[1] += corner[1] / static_cast<double>(result.corners.size());
  }
  const auto angle = [&](const std::array<double, 2>& corner) {
    return std::atan2(corner[1] - result.centre[1], corner[0] - result.centre[0]);
  };
  std::sort(result.corners.begin(), result.corners.end(),
            [&](const auto& a, const auto& b) { return angle(a) < angle(b); });
  return result;
}

}  // namespace

MidPlane cut_mid_plane(const std::vector<double>& points, const std::vector<std::int64_t>& cell_points) {
  double front = std::numeric_limits<double>::infinity();
  double back = -front;
  for (std::size_t i = 1; i < points.size(); i += 3) {
    front = std::min(front, points[i]);
    back = std::max(back, points[i]);
  }
  MidPlane plane;
  plane.y = (front + back) / 2;
  for (std::size_t i = 1; i < points.size(); i += 3) {
    if (std::abs(points[i] - (front + back) / 2) < 1e-6 * (back - front)) {
      plane.y = (front + back) / 2 + 1e-3 * (back - front);
      break;
    }
  }
  std::array<std::array<double, 3>, 8> corners{};
  for (std::size_t cell = 0; cell < cell_points.size() / 8; ++cell) {
    for (std::size_t i = 0; i < 8; ++i) {
      const auto point = static_cast<std::size_t>(cell_points[8 * cell + i]);
      corners[i] = {points.at(3 * point), points.at(3 * point + 1), points.at(3 * point + 2)};
    }
    CutCell cell_cut = cut(cell, corners, plane.y);
    if (cell_cut.corners.size() >= 3) {
      plane.cells.push_back(std::move(cell_cut));
    }
  }
  return plane;
}

}  // namespace cupola
