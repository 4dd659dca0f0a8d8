#pragma once
#include <cstdint>
#include <vector>

#include "physics/mesh/bed_mesh.hpp"

namespace cupola {

/// Steady velocity field given by face fluxes: inside a hexahedron the lowest-order Raviart-Thomas field mapped by the cell's
/// Jacobian (Piola).  In reference coordinates each component depends on its own coordinate alone, so that paths through a cell
/// are exact exponentials of a pseudo-time ds = dt/(storage |J|) (Pollock 1988, generalised to hexahedra), and real time is a smooth
/// integral of |J|.  No path crosses a face without flux; a uniform field moves a grid of points uniformly to round-off on cells
/// that are trapezoids extruded along y.
class PathField {
 public:
  /// @param face_flux volume flux through each face of BedMesh, out of its owner, m3/s
  /// @param storage   fraction by which the flux is divided to give the velocity (f alpha_p), all cells, positive
  PathField(const BedMesh& mesh, std::vector<double> face_flux, std::vector<double> storage);

  struct Point {
    std::int64_t cell = -1;
    Vector3 reference{};   ///< in [0,1]^3
  };
  /// Where a path ended.
  enum class End { time_up, left_through_outflow, stagnant };

  /// Physical position of a point, and back (Newton). `locate_in` clamps to the cell.
  [[nodiscard]] Vector3 position(const Point& point) const;
  [[nodiscard]] Point locate_in(std::int64_t cell, const Vector3& position) const;
  [[nodiscard]] Vector3 velocity(const Point& point) const;

  /// Moves the point along its path for `seconds`, across cells and periodic sides.  `residence` (may be null) is called for each
  /// cell crossed: (cell, seconds).
  End advance(Point& point, double seconds, void (*residence)(void*, std::int64_t, double) = nullptr, void* context = nullptr) const;

 private:
  const BedMesh& mesh_;
  std::vector<double> face_flux_;
  std::vector<double> storage_;
};

}  // namespace cupola
