#include "stage_tracer/cohesive_zone.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace cupola {
namespace {

constexpr double none = std::numeric_limits<double>::quiet_NaN();

double highest_crossing(const BedMesh& mesh, const Column& column, const std::vector<double>& temperature,
                        double level) {
  for (std::size_t i = 0; i + 1 < column.cells.size(); ++i) {
    const double upper = temperature[column.cells[i]];
    const double lower = temperature[column.cells[i + 1]];
    if (upper < level && lower >= level) {
      const double z_upper = mesh.cell_centre[column.cells[i]][2];
      const double z_lower = mesh.cell_centre[column.cells[i + 1]][2];
      return z_upper + (z_lower - z_upper) * (level - upper) / (lower - upper);
    }
  }
  return none;
}

}  // namespace

Isotherm find_isotherm(const BedMesh& mesh, const std::vector<Column>& columns, const std::vector<double>& temperature,
                       double level) {
  Isotherm result;
  double area = 0;
  double weighted = 0;
  result.height_min = std::numeric_limits<double>::infinity();
  result.height_max = -result.height_min;
  for (const Column& column : columns) {
    const double height = highest_crossing(mesh, column, temperature, level);
    result.height.push_back(height);
    if (std::isnan(height)) {
      ++result.columns_without;
      continue;
    }
    area += column.area;
    weighted += column.area * height;
    result.height_min = std::min(result.height_min, height);
    result.height_max = std::max(result.height_max, height);
  }
  if (area > 0) {
    result.height_mean = weighted / area;
  } else {
    result.height_mean = result.height_min = result.height_max = none;
  }
  return result;
}

}  // namespace cupola
