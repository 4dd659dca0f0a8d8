#pragma once
#include <filesystem>
#include <memory>
#include <vector>

#include "physics/mesh/bed_mesh.hpp"

namespace Foam {
class fvMesh;
}

namespace cupola {

/// OpenFOAM started once for this process (argList, MPI, Time, errors as exceptions) on the case `TASK/foam`, decomposed where
/// there are several ranks, and the way between its fields and the arrays of BedMesh.
/// Make exactly one, before anything else that needs MPI; it finalises MPI at the end.
class FoamCase {
 public:
  explicit FoamCase(const std::filesystem::path& foam_folder, int& argc, char**& argv);
  ~FoamCase();
  FoamCase(const FoamCase&) = delete;
  FoamCase& operator=(const FoamCase&) = delete;

  [[nodiscard]] Foam::fvMesh& mesh();
  [[nodiscard]] int rank() const;
  [[nodiscard]] int ranks() const;

  /// Undecomposed cell index of each local cell.
  [[nodiscard]] const std::vector<std::int64_t>& global_cell() const;
  /// Local part of an array over all cells.
  [[nodiscard]] std::vector<double> local(const std::vector<double>& all_cells) const;
  /// Array over all cells, on every rank, from the ranks' local parts. `columns` values a cell.
  [[nodiscard]] std::vector<double> everywhere(const std::vector<double>& local_cells, std::size_t columns = 1) const;

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace cupola
