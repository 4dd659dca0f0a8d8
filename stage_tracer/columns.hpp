#pragma once
#include <cstdint>
#include <vector>

#include "physics/mesh/bed_mesh.hpp"

namespace cupola {

/// A vertical stack of cells of the mesh, from the top down, bed cells only.
struct Column {
  std::vector<std::int64_t> cells;
  double x = 0;     ///< m, of the uppermost cell's centre
  double area = 0;  ///< m2 in plan, of the uppermost cell
};

/// The x-y columns of the mesh: cells linked through their zeta faces.
/// @param bed which cells belong to the bed (size cells)
std::vector<Column> mesh_columns(const BedMesh& mesh, const std::vector<bool>& bed);

}  // namespace cupola
