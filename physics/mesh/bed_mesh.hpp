#pragma once
#include <array>
#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "schemas/campaign.hpp"

namespace cupola {

/// The undecomposed hexahedral mesh as plain arrays, the same on every rank: what moves and counts grains works on it,
/// so that any rank can place any grain and no grain has to travel.  Per-cell sums of the ranks are added up
/// (MPI_Allreduce).  Gas fields live in OpenFOAM on the decomposed mesh; FoamCase carries them over.  About 0.6 kB a
/// cell.
///
/// Cells and faces are numbered as in the undecomposed OpenFOAM mesh: internal faces first, then the patches in turn.
/// Periodic sides are two boundary faces each; `face_partner` names the other one.
class BedMesh {
 public:
  enum class PatchKind { wall, inlet, outlet, periodic };
  struct Patch {
    std::string name;  ///< `wall`, `bottom`, `outlet`, `front`, `back`, or the inlet's name
    PatchKind kind = PatchKind::wall;
    std::int64_t first_face = 0;
    std::int64_t faces = 0;
  };

  /// Reads `foam/mesh.hdf`. @throws Failure wrong_input, input_output
  static BedMesh read(const std::filesystem::path& file);
  /// Writes it (docs/contracts.md); the content is the same to the byte for the same mesh and campaign.
  /// @throws Failure input_output
  void write(const std::filesystem::path& file, const std::string& campaign_hash) const;

  [[nodiscard]] std::size_t cells() const { return cell_volume.size(); }
  [[nodiscard]] std::size_t faces() const { return face_owner.size(); }
  [[nodiscard]] std::size_t internal_faces() const { return internal_face_count; }
  /// Null where there is no such patch.
  [[nodiscard]] const Patch* find_patch(const std::string& name) const;
  /// The patch a boundary face belongs to; null for an internal face.
  [[nodiscard]] const Patch* patch_of(std::int64_t face) const;
  /// The cell across a face of `cell`, through periodic sides too; -1 where there is none.
  [[nodiscard]] std::int64_t across(std::int64_t cell, std::int64_t face) const {
    const auto i = static_cast<std::size_t>(face);
    return face_owner[i] == cell ? face_neighbour[i] : face_owner[i];
  }

  /// Sets `lower` and `upper` from the points.
  void find_bounds();

  std::string hash;  ///< of mesh.hdf; in every field file
  std::vector<Vector3> points;
  std::vector<std::array<std::int64_t, 8>> cell_points;  ///< VTK hexahedron order: 0-3 lower ring, 4-7 upper ring
  std::vector<std::array<std::int64_t, 6>> cell_faces;   ///< in reference order xi-, xi+, eta-, eta+, zeta-, zeta+
  std::vector<double> cell_volume;                       ///< m3
  std::vector<Vector3> cell_centre;                      ///< m
  std::vector<std::array<std::int64_t, 4>> face_points;
  std::vector<std::int64_t> face_owner;
  std::vector<std::int64_t>
      face_neighbour;  ///< cell on the other side; -1 on walls, inlets, outlet; across periodic sides
  std::vector<std::int64_t> face_partner;  ///< the other face of a periodic pair; -1 elsewhere
  std::vector<Vector3> face_area;          ///< m2, out of the owner
  std::vector<Vector3> face_centre;        ///< m
  std::size_t internal_face_count = 0;
  std::vector<Patch> patches;
  double periodic_depth = 0;  ///< m; period along y, 0 with walls
  Vector3 lower{}, upper{};   ///< bounding box
};

}  // namespace cupola
