#pragma once
#include <mpi.h>

#include <functional>
#include <optional>
#include <span>
#include <vector>

#include "physics/mesh/cell_locator.hpp"
#include "physics/projection/cell_spreading.hpp"
#include "physics/projection/cell_sums.hpp"
#include "stage_dem/engine.hpp"

namespace cupola {

/// The parcels of this rank divided over the cells of the mesh, and sums over all ranks.  A parcel's material volume
/// (what the gas sees) and its contact volume are both divided by the same shares, which add up to one.
///
/// With `dem.void_fraction: smoothed` the sums over the cells are spread further by the kernel of `CellSpreading` (a
/// diffusion with the variance of a sphere of `dem.smoothing_length`), for parcels larger than cells.  It conserves
/// every sum, and its transpose (`gather`) gives the parcels what the gas of those same cells gives.
class SolidsOnMesh {
 public:
  SolidsOnMesh(const BedMesh& mesh, const Campaign& campaign, MPI_Comm communicator);

  /// Divides these parcels (an engine's `owned`); those above the mesh, in the charging hopper, are left out.
  void divide(const std::vector<Parcel>& owned);

  /// Cells and shares of the i-th parcel; empty above the mesh.
  [[nodiscard]] std::span<const CellShare> shares(std::size_t parcel) const;
  /// Cell of the i-th parcel's centre; -1 above the mesh.
  [[nodiscard]] std::int64_t cell(std::size_t parcel) const { return cell_[parcel]; }

  /// Material volume by species and cell, m3, over all ranks: [species][cell].
  [[nodiscard]] const std::vector<std::vector<double>>& species_volume() const { return species_volume_; }
  /// The same over all species, m3.
  [[nodiscard]] const std::vector<double>& volume() const { return volume_; }

  /// Cell values as the parcels of each cell see them, in place: the transpose of the smoothing; nothing with
  /// `divided`.
  void gather(std::vector<double>& values) const {
    if (smoothing_) smoothing_->gather(values);
  }

  /// Sums over parcels and ranks of `columns` values a parcel, divided over the cells: cells x columns, row-major.
  /// @param value writes the parcel's values; returns false to leave the parcel out
  [[nodiscard]] std::vector<double> sums(std::size_t columns,
                                         const std::function<bool(std::size_t, std::span<double>)>& value) const;

  [[nodiscard]] const CellLocator& locator() const { return locator_; }

 private:
  const BedMesh& mesh_;
  const Campaign& campaign_;
  MPI_Comm communicator_;
  CellLocator locator_;
  std::optional<CellSpreading> smoothing_;
  std::vector<std::size_t> first_;  ///< of each parcel in shares_, and one past the last
  std::vector<CellShare> shares_;
  std::vector<std::int64_t> cell_;
  std::vector<std::vector<double>> species_volume_;
  std::vector<double> volume_;
};

}  // namespace cupola
