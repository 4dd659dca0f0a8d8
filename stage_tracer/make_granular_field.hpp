#pragma once
#include <vector>

#include "physics/mesh/foam_case.hpp"
#include "stage_tracer/dem_result.hpp"
#include "stage_tracer/granular_field.hpp"

namespace cupola {

/// Scales the DEM field to the campaign's descent rate, cleans it (where `tracer.clean_field`) and finds stock faces,
/// raceway removal and stagnant cells.  Without raceways or removal in the DEM stage the field cannot be tied to a
/// known sink: then it is scaled to the descent at the stock plane and interpolated as it is.  A descent rate of 0
/// gives a bed at rest.
/// @param ore_temperature what the DEM stage softened and melted by, K, all cells; empty without heat
GranularField make_granular_field(FoamCase& foam, const BedMesh& mesh, const Campaign& campaign, const DemResult& dem,
                                  const std::vector<double>& ore_temperature);

}  // namespace cupola
