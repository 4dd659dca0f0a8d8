#pragma once
#include <array>
#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "schemas/campaign.hpp"

namespace cupola {

/// The undecomposed hexahedral mesh as plain arrays, the same on every rank: what moves and counts grains works on it, so that any
/// rank can place any grain and no grain has to travel.  Per-cell sums of the ranks are added up (MPI_Allreduce).  Gas fields
/// live in OpenFOAM on the decomposed mesh; FoamCase carries them over.  About 0.6 kB a cell.
///
/// Cells and faces are numbered as in the undecomposed OpenFOAM mesh: internal faces first, then the patches in turn.  Periodic
/// sides are two boundary faces each; `face_partner` names the other one.
class BedMesh {
 public:
  enum class PatchKind { wall, inlet, outlet, periodic };
  struct Patch {
    std::string name;         ///< `wall`, `bottom`, `outlet`, `front`, `back`, or the inlet's name
    PatchKind kind = PatchKind::wall;
    std::int64_t first_face = 0;
    std::int64_t faces = 0;
  };

  /// Reads `foam/mesh.hdf`. @throws Failure wrong_input, input_output
  static BedMesh read(const std::filesystem::path& file);

  [[nodiscard]] std::size_t cells() const { return cell_volume.size(); }
  [[nodiscard]] std::size_t faces() const { return face_owner.size(); }
  [[nodiscard]] std::size_t internal_faces() const { return internal_face_count; }
  [[nodiscard]] const Patch* find_patch(const std::string& name) const;

  std::string hash;                                     ///< of mesh.hdf; in every field file
  std::vector<Vector3> points;
  std::vector<std::array<std::int64_t, 8>> cell_points; ///< VTK hexahedron order: 0-3 lower ring, 4-7 upper ring
  std::vector<std::array<std::int64_t, 6>> cell_faces;  ///< in reference order xi-, xi+, eta-, eta+, zeta-, zeta+
  std::vector<double> cell_volume;                      ///< m3
  std::vector<Vector3> cell_centre;                     ///< m
  std::vector<std::array<std::int64_t, 4>> face_points;
  std::vector<std::int64_t> face_owner;
  std::vector<std::int64_t> face_neighbour;             ///< cell on the other side; -1 on walls, inlets, outlet; across periodic sides
  std::vector<std::int64_t> face_partner;               ///< the other face of a periodic pair; -1 elsewhere
  std::vector<Vector3> face_area;                       ///< m2, out of the owner
  std::vector<Vector3> face_centre;                     ///< m
  std::size_t internal_face_count = 0;
  std::vector<Patch> patches;
  double periodic_depth = 0;                            ///< m; period along y, 0 with walls
  Vector3 lower{}, upper{};                             ///< bounding box
};

}  // namespace cupola
