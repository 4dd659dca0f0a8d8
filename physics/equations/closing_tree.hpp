#pragma once
#include <cstdint>
#include <functional>
#include <vector>

#include "physics/mesh/bed_mesh.hpp"

namespace cupola {

/// Makes fluxes through faces conserve to round-off: what an iterative solution has left over in the cells is passed on
/// from cell to cell towards the openings, along the shortest ways through internal faces (a spanning tree, made
/// once).  The flux of no face changes by more than the sum of what is left over.
class ClosingTree {
 public:
  /// @param open whether a boundary face may take what arrives at it
  ClosingTree(const BedMesh& mesh, const std::function<bool(std::size_t face)>& open);

  /// Changes `face_flux` (out of the owners, all faces) so that the sum of fluxes out of each cell is 0.  Cells from
  /// which no opening can be reached stay as they are.
  void close(std::vector<double>& face_flux) const;

 private:
  /// A cell and the face towards its opening.
  struct Branch {
    std::int32_t cell, face, beyond;  ///< beyond: next cell on the way, -1 behind an opening
  };
  const BedMesh& mesh_;
  std::vector<Branch> branches_;  ///< nearest to the openings first
};

}  // namespace cupola
