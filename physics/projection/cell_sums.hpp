#pragma once
#include <cstdint>
#include <vector>

#include "physics/mesh/bed_mesh.hpp"
#include "physics/mesh/cell_locator.hpp"

namespace cupola {

/// The cells a parcel's volume lies in and the share of it in each (sum 1 to round-off).
struct CellShare {
  std::int64_t cell;
  double share;
};

/// Divided void fraction: the parcel's volume in equal parts at satellite points (centre and two shells), each counted
/// in the cell that holds it; a point outside the mesh falls back to the centre's cell, so that the volume is conserved
/// exactly for any ratio of parcel to cell.  y wraps across periodic sides.
/// @param guess cell of the centre at the last call, or -1; updated
/// @return number of shares written (0 where the centre is outside the mesh)
std::size_t divide_parcel(const CellLocator& locator, const Vector3& centre, double radius, std::int64_t& guess,
                          std::vector<CellShare>& shares);

}  // namespace cupola
