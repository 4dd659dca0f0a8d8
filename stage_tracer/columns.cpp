#include "stage_tracer/columns.hpp"

#include <cmath>

namespace cupola {
namespace {

constexpr std::size_t below = 4;  // zeta-
constexpr std::size_t above = 5;  // zeta+

}  // namespace

std::vector<Column> mesh_columns(const BedMesh& mesh, const std::vector<bool>& bed) {
  std::vector<Column> columns;
  for (std::size_t c = 0; c < mesh.cells(); ++c) {
    if (!bed[c]) continue;
    const std::int64_t higher = mesh.across(static_cast<std::int64_t>(c), mesh.cell_faces[c][above]);
    if (higher >= 0 && bed[higher]) continue;
    Column column;
    column.x = mesh.cell_centre[c][0];
    column.area = std::abs(mesh.face_area[mesh.cell_faces[c][above]][2]);
    for (auto cell = static_cast<std::int64_t>(c); cell >= 0 && bed[cell];
         cell = mesh.across(cell, mesh.cell_faces[cell][below])) {
      column.cells.push_back(cell);
    }
    columns.push_back(std::move(column));
  }
  return columns;
}

}  // namespace cupola
