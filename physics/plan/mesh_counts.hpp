#pragma once
#include <cstddef>
#include <vector>

#include "schemas/campaign.hpp"

namespace cupola {

/// The block structure of the mesh, which follows from the campaign alone: what blockMesh is told and what `explain`
/// prints.
///
/// Blocks lie between planes of vertices.  In height: the corners of the profile, the lower and upper edges of the
/// tuyeres and the stock line where it is inside; along the depth: front, back and the sides of the tuyeres; across:
/// the two walls and x = 0.  Cells are even within a block and nowhere larger than `cell`, except across the slot,
/// where their number is the same at every height: that whose cells, at the mean half width, are not larger
/// than `cell`. Where `scene.mesh.cells` states the counts, these are shared out so that the longest edge is as short
/// as can be.
struct MeshCounts {
  std::vector<double> levels;    ///< m, heights of the planes, rising; n + 1 for n rows of blocks
  std::vector<int> rows;         ///< cells between one level and the next
  std::vector<double> sections;  ///< m, y of the planes, rising
  std::vector<int> slices;       ///< cells between one section and the next
  int columns = 0;               ///< cells from x = 0 to one wall

  [[nodiscard]] std::size_t rows_in_all() const;
  [[nodiscard]] std::size_t slices_in_all() const;
  [[nodiscard]] std::size_t cells() const;
};

/// @throws Failure wrong_input where a tuyere does not fit its wall (names the inlet)
MeshCounts mesh_counts(const Campaign& campaign);

/// Volume of the slot between two heights, m3: exact for the profile's straight walls.
double slot_volume(const Campaign& campaign, double from, double to);

}  // namespace cupola
