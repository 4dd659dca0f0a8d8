#pragma once
#include <vector>

#include "physics/equations/cell_equation.hpp"
#include "physics/equations/face_geometry.hpp"
#include "physics/mesh/bed_mesh.hpp"
#include "physics/mesh/foam_case.hpp"

namespace cupola {

/// Faces of the bed, and the correction of fluxes through them by a potential: what cleaning a measured granular field
/// and predicting one share.
class BedFaces {
 public:
  /// Keeps references. @param bed cells below the stock plane
  BedFaces(const BedMesh& mesh, const FaceGeometry& geometry, const std::vector<bool>& bed)
      : mesh_(mesh), geometry_(geometry), bed_(bed) {}

  /// Between two cells of the bed.
  [[nodiscard]] bool inside(std::size_t face) const {
    const auto neighbour = mesh_.face_neighbour[face];
    return neighbour >= 0 && bed_[mesh_.face_owner[face]] && bed_[neighbour];
  }
  /// Between bed and freeboard, or the outlet where the bed fills the mesh; facing up or down.
  [[nodiscard]] bool in_stock_plane(std::size_t face) const;
  /// The bed's cell at a face of the stock plane.
  [[nodiscard]] std::int64_t cell_below(std::size_t face) const {
    return bed_[mesh_.face_owner[face]] ? mesh_.face_owner[face] : mesh_.face_neighbour[face];
  }
  /// Sets the fluxes of the stock plane to a total inflow, split in proportion to `share` (by area where that is zero
  /// everywhere).
  /// @param share [face], not negative; read at the stock plane only
  /// @throws Failure wrong_input where no face lies in the stock plane
  void set_inflow(double total, const std::vector<double>& share, std::vector<double>& face_flux) const;

 private:
  const BedMesh& mesh_;
  const FaceGeometry& geometry_;
  const std::vector<bool>& bed_;
};

/// Corrects fluxes inside the bed by w grad(phi), with the mobility w of the cells (harmonic in the faces), so that
/// their divergence is the given one: of all corrections the smallest in the norm weighted with 1/w.
class BedProjection {
 public:
  /// Keeps references.
  BedProjection(FoamCase& foam, const BedMesh& mesh, const FaceGeometry& geometry, const std::vector<bool>& bed)
      : mesh_(mesh),
        geometry_(geometry),
        bed_(bed),
        faces_(mesh, geometry, bed),
        equation_(foam, mesh),
        potential_(mesh.cells(), 0.0) {}

  /// The potential of the last call is where the next one starts from.
  /// @param mobility all cells, positive in the bed  @param sink what is to disappear in each cell, m3/s
  /// @param tolerance of the divergence's error, summed over cells, and @param acceptable what may be left, m3/s
  /// @throws Failure diverged
  void project(const std::vector<double>& mobility, const std::vector<double>& sink, double tolerance,
               double acceptable, std::vector<double>& face_flux);

 private:
  const BedMesh& mesh_;
  const FaceGeometry& geometry_;
  const std::vector<bool>& bed_;
  BedFaces faces_;
  CellEquation equation_;
  std::vector<double> potential_;
};

}  // namespace cupola
