#pragma once
#include <cstdint>
#include <memory>

#include "physics/mesh/bed_mesh.hpp"

namespace cupola {

/// Finds the cell that holds a point: the last cell and its neighbours first, then a uniform grid of candidates.
class CellLocator {
 public:
  explicit CellLocator(const BedMesh& mesh);
  ~CellLocator();
  CellLocator(CellLocator&&) noexcept;
  CellLocator& operator=(CellLocator&&) noexcept;

  /// The cell, or -1 outside the mesh.  y wraps where the sides are periodic.  `guess` may be -1.
  [[nodiscard]] std::int64_t find(const Vector3& point, std::int64_t guess = -1) const;
  /// The cell whose centre is nearest among the candidates near the point (for points just outside a wall); -1 if far
  /// away.
  [[nodiscard]] std::int64_t nearest(const Vector3& point) const;

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace cupola
