#pragma once
#include <array>
#include <cstdint>
#include <vector>

#include "physics/mesh/bed_mesh.hpp"

namespace cupola {

/// Steady velocity field given by face fluxes: inside a hexahedron the lowest-order Raviart-Thomas field mapped by the
/// cell's Jacobian J (Piola).  In reference coordinates each component depends on its own coordinate alone,
///   d xi/d tau = q- (1 - xi) + q+ xi,   d tau = dt/(storage |J|),
/// q the fluxes through the two faces in the sense of xi, so that paths through a cell are exact exponentials of the
/// pseudo-time tau (Pollock 1988, generalised to hexahedra), and real time is the integral of storage |J| along them:
/// in closed form where |J| changes with zeta alone and linearly (the slot's trapezoids), else by Gauss-Legendre
/// quadrature.
///
/// No path crosses a face without flux.  A uniform field in the plane of the slot moves a grid of points uniformly, to
/// round-off, on trapezoids extruded along y.
class PathField {
 public:
  /// Keeps a reference to the mesh, whose reference axes must agree across faces (as prepare's do).
  /// @param face_flux volume flux through each face of BedMesh, out of its owner, m3/s
  /// @param storage   fraction by which the flux is divided to give the velocity (f alpha_p), all cells, positive
  /// @throws Failure wrong_input where lengths, storage or the mesh do not fit
  PathField(const BedMesh& mesh, const std::vector<double>& face_flux, const std::vector<double>& storage);

  struct Point {
    std::int64_t cell = -1;
    Vector3 reference{};  ///< in [0,1]^3
  };
  /// A part of a path, inside one cell.
  struct Stay {
    std::int32_t cell = -1;
    double seconds = 0;
  };
  /// Where a path ended.
  enum class End { time_up, left_through_outflow, stagnant };

  /// Physical position of a point, and back (Newton). `locate_in` clamps to the cell.
  [[nodiscard]] Vector3 position(const Point& point) const;
  [[nodiscard]] Point locate_in(std::int64_t cell, const Vector3& position) const;
  [[nodiscard]] Vector3 velocity(const Point& point) const;

  /// Moves the point along its path for `seconds`, across cells and periodic sides.  `residence` (may be null) is
  /// called for each stay in a cell: (cell, seconds); the stays add up to `seconds`, less what is left of them where
  /// the path leaves through an outflow: the point then stays on that face.
  End advance(Point& point, double seconds, void (*residence)(void*, std::int64_t, double) = nullptr,
              void* context = nullptr) const;

  /// Moves the point as above and appends its stays.
  End advance(Point& point, double seconds, std::vector<Stay>& stays) const;

  /// Height of the lowest corner of a cell, m.
  [[nodiscard]] double lowest(std::int64_t cell) const;

  /// Solids volume of the cell over what flows through it, s: the mean time of a stay. Infinite in a cell without flow.
  [[nodiscard]] double crossing_time(std::int64_t cell) const;

  /// Paths that were left standing because they ran round an edge in no time (round-off at a stagnation point).
  [[nodiscard]] std::int64_t fallbacks() const { return fallbacks_; }

 private:
  /// All a path needs of a cell; 112 bytes.
  struct Cell {
    Vector3 flux{};                    ///< at reference coordinate 0, in the sense of the axis, m3/s
    Vector3 change{};                  ///< flux at 1 less flux at 0, m3/s
    double storage_volume = 0;         ///< storage |J| at zeta = 0, m3
    double storage_volume_change = 0;  ///< its change to zeta = 1
    double storage = 0;
    std::array<std::int32_t, 6> neighbour{};  ///< behind xi-, xi+, eta-, eta+, zeta-, zeta+; -1 none
    bool linear_volume = true;                ///< |J| is given by the two members above
  };
  /// What the rates at a point and the way to the exit are.
  struct Exit;

  template <typename Visit>
  End follow(Point& point, double seconds, const Visit& visit) const;
  [[nodiscard]] static Exit look_ahead(const Cell& cell, const Vector3& reference);
  static void find_exit(const Cell& cell, Exit& exit);
  [[nodiscard]] double elapsed(std::size_t cell, const Vector3& reference, const Vector3& rate, double pseudo) const;
  [[nodiscard]] double pseudo_time(std::size_t cell, const Vector3& reference, const Exit& exit, double seconds) const;

  const BedMesh& mesh_;
  std::vector<Cell> cells_;
  mutable std::int64_t fallbacks_ = 0;
};

}  // namespace cupola
