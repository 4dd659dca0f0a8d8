#pragma once
#include <utility>
#include <vector>

#include "schemas/campaign.hpp"
#include "stage_tracer/cell_contents.hpp"

namespace cupola {

/// Time means over the last layer passage (MODEL 11, 19).
class Averages {
 public:
  Averages(std::size_t species, std::size_t cells, bool heat);

  /// @param contents spread with the kernel of a parcel, which is the smoothing over a parcel diameter
  void add(const CellContents& contents, const Campaign& campaign, double seconds);

  [[nodiscard]] double seconds() const { return seconds_; }
  /// Mean volume in each cell, m3, [species][cell].
  [[nodiscard]] BySpecies volume() const;
  /// Heat-capacity weighted mean temperature, K, [species][cell]; 0 where the species never was.
  [[nodiscard]] BySpecies temperature() const;
  /// Heat-capacity weighted mean over all solids, K.
  [[nodiscard]] double mean_solid_temperature() const { return seconds_ > 0 ? mean_ / seconds_ : 0; }

  /// Heat capacity (J/K) and mean temperature (K) of all solids in each cell.
  [[nodiscard]] std::pair<std::vector<double>, std::vector<double>> solids(const Campaign& campaign) const;

  /// Begins anew.
  void clear();

  [[nodiscard]] std::vector<double> row() const;
  void restore(const std::vector<double>& row);

 private:
  std::size_t species_;
  std::size_t cells_;
  bool heat_;
  double seconds_ = 0;
  double mean_ = 0;                         ///< K s
  std::vector<double> volume_;              ///< m3 s, species x cells
  std::vector<double> volume_temperature_;  ///< m3 K s
};

/// Heat-capacity weighted mean temperature of all tracers, K.
double mean_temperature(const CellContents& contents, const Campaign& campaign);

}  // namespace cupola
