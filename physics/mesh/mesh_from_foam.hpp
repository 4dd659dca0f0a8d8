#pragma once
#include <filesystem>

#include "physics/mesh/bed_mesh.hpp"
#include "schemas/campaign.hpp"

namespace cupola {

/// Reads the undecomposed OpenFOAM mesh of a case, in this process and on one rank, and orders each cell's points and
/// faces as BedMesh wants them: xi, eta, zeta along x, y, z.
/// @throws Failure input_output (no readable mesh), wrong_input (a cell that is no hexahedron between levels and
/// sections)
BedMesh mesh_from_foam(const std::filesystem::path& case_folder, const Campaign& campaign);

}  // namespace cupola
