#pragma once
#include <filesystem>

#include "schemas/task.hpp"

namespace cupola {

/// `cupola-dem prepare TASK` and `cupola-tracer prepare TASK`, on one process: writes `foam/` of the task: OpenFOAM
/// case with blockMeshDict, runs blockMesh and checkMesh, decomposes for `launch.ranks`, writes `foam/mesh.hdf`
/// (BedMesh) and `foam/wall.stl` (wall_triangles.hpp).  A folder `foam/` is there only when it is whole; where one is
/// there for the same campaign, program and ranks nothing is done.
/// @throws Failure wrong_input (a tuyere the mesh does not hold, an inlet outside the wall, too shallow periodic
/// sides),
///         input_output
void prepare(const std::filesystem::path& task_folder, const Task& task);

}  // namespace cupola
