#pragma once
#include <filesystem>

#include "schemas/task.hpp"

namespace cupola {

/// `cupola-dem prepare TASK` and `cupola-tracer prepare TASK`, on one process: writes `foam/` of the task: OpenFOAM case with
/// blockMeshDict, runs blockMesh and checkMesh, decomposes for `launch.ranks`, writes `foam/mesh.hdf` (BedMesh) and
/// `foam/wall.stl` (wall patches as triangles of at most 0.5 m, continued upwards by the charging hopper for the DEM stage).
/// @throws Failure wrong_input (a tuyere the mesh does not hold, an inlet outside the wall, too shallow periodic sides), input_output
void prepare(const std::filesystem::path& task_folder, const Task& task);

/// Height of the top of the charging hopper: mesh top plus the thickest batch (mass/density/0.55 over the throat's area) plus 0.5 m.
double hopper_top(const Campaign& campaign);

}  // namespace cupola
