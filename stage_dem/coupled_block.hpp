#pragma once
#include <functional>

#include "stage_dem/dem_gas.hpp"
#include "stage_dem/engine.hpp"
#include "stage_dem/solids_on_mesh.hpp"

namespace cupola {

/// One block of `steps` steps of the engine (`step` s each) with a gas that moves with the bed: the parcels are divided
/// over the mesh, the gas makes a step, its forces act on the parcels until the next one; as often as the gas wants.
/// @param seen where given, is called after each of the gas's steps with its length, s
/// @return wall time of all that is not the engine's, s
double advance_with_gas(Engine& engine, SolidsOnMesh& solids, DemGas& gas, double step, long steps,
                        const std::function<void(double)>& seen = {});

}  // namespace cupola
