#pragma once
#include <memory>
#include <string>
#include <vector>

#include "physics/mesh/bed_mesh.hpp"
#include "physics/mesh/foam_case.hpp"

namespace cupola {

/// Coefficients of a linear equation with one unknown a cell, coupled through the faces (BedMesh numbering):
///   (A x)_P = diagonal_P x_P - sum over the faces of P of coefficient x_N.
struct CellCoefficients {
  std::vector<double> diagonal;       ///< all cells
  std::vector<double> owner_row;      ///< all faces: coefficient of the neighbour's value in the owner's row
  std::vector<double> neighbour_row;  ///< internal faces: coefficient of the owner's value in the neighbour's row
  bool symmetric = true;              ///< owner_row == neighbour_row: multigrid; else stabilised bi-conjugate gradients
};

/// Solves such equations with OpenFOAM's solvers on the decomposed mesh.  Arrays in and out are over all cells and
/// faces, the same on every rank; the residual is evaluated on them, so that what is promised of it holds on any number
/// of ranks.
class CellEquation {
 public:
  CellEquation(FoamCase& foam, const BedMesh& mesh);
  ~CellEquation();
  CellEquation(CellEquation&&) noexcept;
  CellEquation& operator=(CellEquation&&) noexcept;

  struct Result {
    int cycles = 0;       ///< multigrid cycles or iterations
    double residual = 0;  ///< sum over cells of |source - A x|
  };
  /// Improves x until sum |source - A x| <= tolerance, or until rounding lets it fall no further.
  /// @throws Failure diverged: not finite (names the cell), or the residual stays above `acceptable`
  Result solve(const std::string& what, const CellCoefficients& coefficients, const std::vector<double>& source,
               std::vector<double>& x, double tolerance, double acceptable);

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace cupola
