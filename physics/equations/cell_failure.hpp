#pragma once
#include <cstdint>
#include <string>

#include "physics/mesh/bed_mesh.hpp"
#include "schemas/failure.hpp"

namespace cupola {

/// Failure of the kind `diverged` whose sentence ends with the cell and its place: "... in cell 7 at (x, y, z) m".
Failure cell_failure(const BedMesh& mesh, const std::string& sentence, std::size_t cell);

}  // namespace cupola
