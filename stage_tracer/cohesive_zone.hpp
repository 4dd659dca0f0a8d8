#pragma once
#include <vector>

#include "schemas/campaign.hpp"
#include "stage_tracer/columns.hpp"

namespace cupola {

/// Heights of an isotherm of the ore, one a column (MODEL 19).
struct Isotherm {
  std::vector<double> height;  ///< m, highest crossing of each column; NaN where the isotherm does not cross
  double height_mean = 0;      ///< m, weighted by area in plan; NaN without any crossing
  double height_min = 0;
  double height_max = 0;
  int columns_without = 0;
};

/// Highest crossing of `level` a column, linear between cell centres.
/// @param temperature ore temperature, K, all cells
Isotherm find_isotherm(const BedMesh& mesh, const std::vector<Column>& columns, const std::vector<double>& temperature,
                       double level);

}  // namespace cupola
