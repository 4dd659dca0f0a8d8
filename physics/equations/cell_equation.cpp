#include "physics/equations/cell_equation.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "fvMesh.H"
#include "lduMatrix.H"
#include "physics/equations/cell_failure.hpp"
#include "physics/mesh/foam_errors.hpp"
#include "schemas/failure.hpp"
#include "volFields.H"
#include "zeroGradientFvPatchFields.H"

namespace cupola {
namespace {

double sum_of_magnitudes(const std::vector<double>& values) {
  double sum = 0;
  for (const double value : values) sum += std::abs(value);
  return sum;
}

std::vector<double> residual_of(const BedMesh& mesh, const CellCoefficients& coefficients,
                                const std::vector<double>& source, const std::vector<double>& x) {
  std::vector<double> residual(mesh.cells());
  for (std::size_t cell = 0; cell < mesh.cells(); ++cell) {
    residual[cell] = source[cell] - coefficients.diagonal[cell] * x[cell];
  }
  for (std::size_t face = 0; face < mesh.faces(); ++face) {
    const auto neighbour = mesh.face_neighbour[face];
    if (neighbour < 0) continue;
    residual[mesh.face_owner[face]] += coefficients.owner_row[face] * x[neighbour];
    if (face < mesh.internal_faces()) {
      residual[neighbour] += coefficients.neighbour_row[face] * x[mesh.face_owner[face]];
    }
  }
  return residual;
}

/// Below this number of cells incomplete Cholesky is cheaper than a multigrid cycle (docs/gas.md).
constexpr std::size_t multigrid_from_cells = 20000;

Foam::dictionary solver_controls(bool symmetric, bool multigrid, double relative_tolerance) {
  Foam::dictionary controls;
  controls.add("tolerance", 0.0);
  controls.add("relTol", relative_tolerance);
  controls.add("maxIter", Foam::label(multigrid ? 50 : 1000));
  controls.add("solver", Foam::word(symmetric ? "PCG" : "PBiCGStab"));
  if (!symmetric || !multigrid) {
    controls.add("preconditioner", Foam::word(symmetric ? "DIC" : "DILU"));
    return controls;
  }
  // As many sweeps before as after, so that the cycle is symmetric, as conjugate gradients want it: half the cycles.
  Foam::dictionary cycle;
  cycle.add("preconditioner", Foam::word("GAMG"));
  cycle.add("smoother", Foam::word("DIC"));
  cycle.add("nPreSweeps", Foam::label(1));
  cycle.add("nPostSweeps", Foam::label(1));
  cycle.add("nFinestSweeps", Foam::label(1));
  cycle.add("agglomerator", Foam::word("faceAreaPair"));
  cycle.add("mergeLevels", Foam::label(1));
  cycle.add("cacheAgglomeration", Foam::Switch(true));
  cycle.add("nCellsInCoarsestLevel", Foam::label(20));
  cycle.add("tolerance", 0.0);
  // Also the tolerance of the coarsest level, where 0 would mean iterating to the limit every time.
  cycle.add("relTol", 1e-3);
  cycle.add("nVcycles", Foam::label(1));
  controls.add("preconditioner", cycle);
  return controls;
}

}  // namespace

struct CellEquation::State {
  State(FoamCase& foam_case, const BedMesh& bed_mesh)
      : foam(foam_case),
        mesh(bed_mesh),
        correction(Foam::IOobject("cellEquationCorrection", foam.mesh().time().timeName(), foam.mesh(),
                                  Foam::IOobject::NO_READ, Foam::IOobject::NO_WRITE, false),
                   foam.mesh(), Foam::dimensionedScalar("zero", Foam::dimless, 0),
                   Foam::zeroGradientFvPatchScalarField::typeName) {}

  /// Coefficient, in the row of the local owner of a local face, of the value on the other side.
  [[nodiscard]] double in_owners_row(const CellCoefficients& coefficients, Foam::label face) const {
    const auto all_faces = static_cast<std::size_t>(foam.global_face()[face]);
    return (foam.face_sign()[face] > 0 ? coefficients.owner_row : coefficients.neighbour_row)[all_faces];
  }

  /// One call of OpenFOAM's solver: an approximate correction for the residual, over all cells.
  std::vector<double> correct(const std::string& what, const CellCoefficients& coefficients,
                              const std::vector<double>& residual, double relative_tolerance, int& cycles) {
    const Foam::fvMesh& local = foam.mesh();
    Foam::lduMatrix matrix(local);
    const auto diagonal = foam.local(coefficients.diagonal);
    std::copy(diagonal.begin(), diagonal.end(), matrix.diag().begin());
    Foam::scalarField& upper = matrix.upper();
    // Inside a rank OpenFOAM keeps the order of cells, so the owner is the owner.
    forAll(upper, face) upper[face] = -in_owners_row(coefficients, face);
    if (!coefficients.symmetric) {
      Foam::scalarField& lower = matrix.lower();
      forAll(lower, face) lower[face] = -coefficients.neighbour_row[static_cast<std::size_t>(foam.global_face()[face])];
    }
    // Of a coupled patch the solvers subtract coefficient x value on the other side from A x.
    Foam::FieldField<Foam::Field, Foam::scalar> coupling(local.boundary().size());
    Foam::FieldField<Foam::Field, Foam::scalar> on_diagonal(local.boundary().size());
    forAll(local.boundary(), patch) {
      coupling.set(patch, new Foam::scalarField(local.boundary()[patch].size(), 0));
      on_diagonal.set(patch, new Foam::scalarField(local.boundary()[patch].size(), 0));
      if (!local.boundary()[patch].coupled()) continue;
      forAll(local.boundary()[patch], face) {
        coupling[patch][face] = in_owners_row(coefficients, local.boundary()[patch].start() + face);
        on_diagonal[patch][face] = coupling[patch][face];
      }
    }
    const auto local_residual = foam.local(residual);
    Foam::scalarField source(local.nCells());
    std::copy(local_residual.begin(), local_residual.end(), source.begin());
    correction = Foam::dimensionedScalar("zero", Foam::dimless, 0);
    with_foam_errors(ExitCode::diverged, what, [&] {
      const auto solver = Foam::lduMatrix::solver::New(
          correction.name(), matrix, coupling, on_diagonal, correction.boundaryField().scalarInterfaces(),
          solver_controls(coefficients.symmetric, mesh.cells() >= multigrid_from_cells, relative_tolerance));
      cycles += solver->solve(correction.primitiveFieldRef(), source).nIterations();
    });
    const auto& values = correction.primitiveField();
    return foam.everywhere(std::vector<double>(values.begin(), values.end()));
  }

  [[noreturn]] void not_finite(const std::string& what, const std::vector<double>& values) const {
    std::size_t cell = 0;
    while (cell + 1 < values.size() && std::isfinite(values[cell])) ++cell;
    throw cell_failure(mesh, what + " became infinite or undefined, first", cell);
  }

  FoamCase& foam;
  const BedMesh& mesh;
  Foam::volScalarField correction;
};

CellEquation::CellEquation(FoamCase& foam, const BedMesh& mesh) : state_(std::make_unique<State>(foam, mesh)) {}
CellEquation::~CellEquation() = default;
CellEquation::CellEquation(CellEquation&&) noexcept = default;
CellEquation& CellEquation::operator=(CellEquation&&) noexcept = default;

CellEquation::Result CellEquation::solve(const std::string& what, const CellCoefficients& coefficients,
                                         const std::vector<double>& source, std::vector<double>& x, double tolerance,
                                         double acceptable) {
  State& state = *state_;
  Result result;
  std::vector<double> residual = residual_of(state.mesh, coefficients, source, x);
  result.residual = sum_of_magnitudes(residual);
  if (!std::isfinite(result.residual)) state.not_finite(what, residual);
  const bool multigrid = coefficients.symmetric && state.mesh.cells() >= multigrid_from_cells;
  // Multigrid cycles are not quite symmetric, so that long runs of conjugate gradients with them slow down: begin anew
  // more often.
  const double most_at_once = multigrid ? 1e-3 : 1e-10;
  constexpr int most_rounds = 30;
  for (int round = 0; round < most_rounds && result.residual > tolerance; ++round) {
    const double wanted = std::clamp(0.3 * tolerance / result.residual, most_at_once, 0.1);
    const auto correction = state.correct(what, coefficients, residual, wanted, result.cycles);
    auto improved = x;
    for (std::size_t cell = 0; cell < x.size(); ++cell) improved[cell] += correction[cell];
    auto left = residual_of(state.mesh, coefficients, source, improved);
    const double left_sum = sum_of_magnitudes(left);
    if (!std::isfinite(left_sum)) state.not_finite(what, left);
    // Below this only rounding is left: a round that no longer halves the residual is the last.
    const bool stagnant = left_sum > 0.5 * result.residual;
    if (left_sum < result.residual) {
      x = std::move(improved);
      residual = std::move(left);
      result.residual = left_sum;
    }
    if (stagnant) break;
  }
  if (result.residual > acceptable) {
    throw Failure(ExitCode::diverged,
                  fmt::format("{} could not be solved: residual {:.3g} of {:.3g} allowed after {} cycles", what,
                              result.residual, acceptable, result.cycles))
        .advise("scene.mesh.cell", "a mesh with less stretched cells");
  }
  return result;
}

}  // namespace cupola
