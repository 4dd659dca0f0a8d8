#pragma once
#include <nlohmann/json.hpp>

#include "physics/gas/bed_gas.hpp"

namespace cupola {

/// Solves one state of the bed with both gas models and says how they differ in the bed (not in the freeboard), by the
/// distance to the nearest inlet:
/// `{"rows": [{"from", "to" (m; null at the end), "cells", "mass_flux" (rms of the vectors' difference over the rms of
/// Darcy and Forchheimer's), "pressure" (rms of the difference over the rms rise above the outlet's)}], "iterations",
/// "seconds": {"darcy_forchheimer", "navier_stokes"}}`, or `{"failed": sentence}` where one of them has no solution.
/// All ranks take part.
/// @param temperature of the gas, K, all cells
nlohmann::json compare_gas_models(FoamCase& foam, const BedMesh& mesh, const Campaign& campaign, const BedState& bed,
                                  const std::vector<double>& temperature);

}  // namespace cupola
