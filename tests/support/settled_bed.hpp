#pragma once
#include <filesystem>

#include "physics/mesh/bed_mesh.hpp"
#include "schemas/task.hpp"

namespace cupola::testing {

/// Stands in for the DEM stage where a test of the tracer stage needs a DEM result before or without one: the recipe's
/// layers on lattices of the expected packing, ore above the guessed cohesive zone only, a plug flow that follows the
/// walls down to the raceways at `speed_up` times the descent rate, and the summary that belongs to it.
void write_settled_bed(const std::filesystem::path& file, const BedMesh& mesh, const Task& task, double speed_up);

}  // namespace cupola::testing
