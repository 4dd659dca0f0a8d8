#pragma once
#include <string>
#include <vector>

#include "schemas/hdf.hpp"
#include "stage_tracer/averages.hpp"

namespace cupola {

/// Means over each layer passage of a march, kept where a prediction is to be corrected by what the march measures.
class MarchWindows {
 public:
  struct Window {
    double seconds = 0;
    CellContents mean;  ///< spread contents, as `Averages` has them
  };

  MarchWindows(std::size_t species, std::size_t cells) : species_(species), cells_(cells) {}

  void add(const Averages& averages);
  [[nodiscard]] std::size_t size() const { return rows_.size(); }

  /// Flat, for a checkpoint.
  [[nodiscard]] std::vector<double> row() const;
  void restore(const std::vector<double>& row);

  /// `Windows/seconds`, `Windows/volume` (m3) and `Windows/temperature` (K), a row a window, species by species.
  void write(HdfWriter& file) const;
  /// @throws Failure where the file holds none for this bed
  static std::vector<Window> read(const HdfReader& file, std::size_t species, std::size_t cells);

 private:
  std::size_t species_;
  std::size_t cells_;
  std::vector<std::vector<double>> rows_;  ///< of `Averages`
};

}  // namespace cupola
