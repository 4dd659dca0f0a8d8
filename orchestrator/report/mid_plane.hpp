#pragma once
#include <array>
#include <cstdint>
#include <vector>

namespace cupola {

/// A cell cut by a plane y = constant: a polygon in x and z.
struct CutCell {
  std::size_t cell = 0;
  std::vector<std::array<double, 2>> corners;  ///< (x, z) in m, in order around the polygon
  std::array<double, 2> centre{};              ///< mean of the corners
};

/// Cuts hexahedra with the plane in the middle of the mesh's depth.  Where that plane is a face between two layers of
/// cells, it is moved by a thousandth of the depth, so that each place belongs to one cell.
/// @param points n x 3, m; @param cell_points cells x 8, VTK's order of a hexahedron
struct MidPlane {
  double y = 0;  ///< m, where the cut is
  std::vector<CutCell> cells;
};
MidPlane cut_mid_plane(const std::vector<double>& points, const std::vector<std::int64_t>& cell_points);

}  // namespace cupola
