#pragma once
#include <cstdint>
#include <filesystem>
#include <memory>
#include <vector>

#include "physics/mesh/bed_mesh.hpp"

namespace Foam {
class fvMesh;
}

namespace cupola {

/// OpenFOAM started for this process (argList, MPI, Time, errors as exceptions, no chatter, signals and floating-point
/// traps left alone) on the case `TASK/foam`, decomposed where there are several ranks, and the way between its fields
/// and the arrays of BedMesh.
///
/// Make it before anything else that needs MPI.  MPI is initialised by the first one and finalised when the process
/// ends. One at a time; several in turn only on one rank.  A program that uses it links `cupola_foam_environment`.
class FoamCase {
 public:
  /// @throws Failure wrong_input (not prepared, or for another number of ranks), input_output
  explicit FoamCase(const std::filesystem::path& foam_folder, int& argc, char**& argv);
  ~FoamCase();
  FoamCase(const FoamCase&) = delete;
  FoamCase& operator=(const FoamCase&) = delete;

  [[nodiscard]] Foam::fvMesh& mesh();
  [[nodiscard]] const Foam::fvMesh& mesh() const;
  [[nodiscard]] int rank() const;
  [[nodiscard]] int ranks() const;

  /// Undecomposed cell index of each local cell.
  [[nodiscard]] const std::vector<std::int64_t>& global_cell() const;
  /// Local part of an array over all cells.
  [[nodiscard]] std::vector<double> local(const std::vector<double>& all_cells) const;
  /// Array over all cells, on every rank, from the ranks' local parts. `columns` values a cell.
  [[nodiscard]] std::vector<double> everywhere(const std::vector<double>& local_cells, std::size_t columns = 1) const;

  /// Undecomposed face index of each face of the local mesh (internal faces, then the boundary, processor patches
  /// included).
  [[nodiscard]] const std::vector<std::int64_t>& global_face() const;
  /// 1 where the local face looks the same way as the undecomposed one, -1 where it is turned round.
  [[nodiscard]] const std::vector<int>& face_sign() const;
  /// Fluxes through the local faces, out of their local owners, from fluxes through all faces in BedMesh's sense.
  [[nodiscard]] std::vector<double> local_fluxes(const std::vector<double>& all_faces) const;
  /// Fluxes through all faces, on every rank, from the ranks' local parts: the way back.
  [[nodiscard]] std::vector<double> fluxes_everywhere(const std::vector<double>& local_faces) const;

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace cupola
