#include "physics/projection/cell_sums.hpp"

#include <algorithm>
#include <array>
#include <cmath>

namespace cupola {
namespace {

/// Directions to the 8 corners and 6 face centres of a cube.
constexpr std::size_t directions_count = 14;
constexpr std::size_t points_count = 1 + 2 * directions_count;

/// Satellite points on the unit sphere: the volume is cut into a core and two shells so that each of the 29 points
/// stands for the same volume; the points of a shell lie where its second moment asks for, so that the points have the
/// sphere's own variance, R^2/5 an axis.
std::array<Vector3, points_count> satellite_points() {
  const double n = points_count;
  const double inner = std::cbrt(1 / n);
  const double middle = std::cbrt((1 + double{directions_count}) / n);
  const auto shell_radius = [](double from, double to) {
    return std::sqrt(3.0 / 5.0 * (std::pow(to, 5) - std::pow(from, 5)) / (std::pow(to, 3) - std::pow(from, 3)));
  };
  const std::array<double, 2> radii{shell_radius(inner, middle), shell_radius(middle, 1)};
  std::array<Vector3, points_count> points{};
  std::size_t next = 1;
  for (const double radius : radii) {
    for (std::size_t axis = 0; axis < 3; ++axis) {
      for (const double sign : {-1.0, 1.0}) points[next++][axis] = sign * radius;
    }
    const double side = radius / std::sqrt(3.0);
    for (int corner = 0; corner < 8; ++corner) {
      points[next++] = {(corner & 1) != 0 ? side : -side, (corner & 2) != 0 ? side : -side,
                        (corner & 4) != 0 ? side : -side};
    }
  }
  return points;
}

}  // namespace

std::size_t divide_parcel(const CellLocator& locator, const Vector3& centre, double radius, std::int64_t& guess,
                          std::vector<CellShare>& shares) {
  static const auto points = satellite_points();
  shares.clear();
  const auto home = locator.find(centre, guess);
  guess = home;
  if (home < 0) return 0;

  std::array<std::int64_t, points_count> cells{};
  std::array<int, points_count> counts{};
  std::size_t different = 1;
  cells[0] = home;
  counts[0] = 1;
  for (std::size_t point = 1; point < points_count; ++point) {
    const Vector3& offset = points[point];
    auto cell = locator.find(
        {centre[0] + radius * offset[0], centre[1] + radius * offset[1], centre[2] + radius * offset[2]}, home);
    if (cell < 0) cell = home;
    std::size_t place = 0;
    while (place < different && cells[place] != cell) ++place;
    if (place == different) {
      cells[different++] = cell;
    }
    ++counts[place];
  }
  for (std::size_t place = 0; place < different; ++place) {
    shares.push_back({cells[place], counts[place] / static_cast<double>(points_count)});
  }
  return different;
}

}  // namespace cupola
