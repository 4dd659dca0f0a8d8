#pragma once
#include <vector>

#include "schemas/campaign.hpp"
#include "stage_tracer/columns.hpp"

namespace cupola {

/// The ore temperature that the next DEM stage softens and melts by (MODEL 11), in every bed cell, column by column:
/// * where ore is present, its mean temperature made monotone (rising downwards) by weighted isotonic regression, which
/// does not
///   shift the mean as a running maximum would;
/// * above the first ore: that cell's temperature;
/// * below the last ore: continued along the last gradient, at least at the melting temperature, at most one softening
/// interval above it. A column without any ore follows the nearest one (in x) that has some; a bed without any ore
/// counts as melted throughout.
/// @param temperature mean ore temperature, K, all cells; used only where `weight` is above `least_weight`
/// @param weight heat capacity (or volume) of ore in the cell, same unit as least_weight
/// @param outside K, given to cells outside the bed
/// @return K, all cells
std::vector<double> continue_ore_temperature(const BedMesh& mesh, const std::vector<Column>& columns,
                                             const std::vector<double>& temperature, const std::vector<double>& weight,
                                             const std::vector<double>& least_weight, const Softening& softening,
                                             double outside);

/// Weighted isotonic regression (pool adjacent violators): the non-decreasing sequence nearest to `values` in weighted
/// least squares.
std::vector<double> isotonic(const std::vector<double>& values, const std::vector<double>& weights);

}  // namespace cupola
