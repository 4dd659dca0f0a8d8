#pragma once
#include <filesystem>
#include <optional>
#include <vector>

#include "physics/mesh/bed_mesh.hpp"
#include "schemas/task.hpp"

namespace cupola {

/// The temperature by which ore softens and melts in the DEM stage (MODEL 11): the field of the tracer stage before,
/// constant in a cell; in the first episode the campaign's guessed inverted V, sharp at its surface; in a cold scene
/// that of the charge.
class OreTemperature {
 public:
  /// Reads the task's input `solids_temperature` where there is one. @throws Failure wrong_input, input_output
  OreTemperature(const Task& task, const std::filesystem::path& task_folder, const BedMesh& mesh);

  /// For scenes without a hand-over: the guess alone.
  explicit OreTemperature(const Campaign& campaign);

  /// At a parcel, K. @param cell that holds the parcel; -1 in the charging hopper: the temperature of the charge
  [[nodiscard]] double at(const Vector3& position, std::int64_t cell) const;

  /// Gas temperature for the gas of this stage, all cells, K: that of the tracer stage before; without one the guess of
  /// the solids, at most the hottest blast.
  [[nodiscard]] const std::vector<double>& gas() const { return gas_; }

 private:
  [[nodiscard]] double guess(const Vector3& position) const;

  std::optional<InvertedV> zone_;
  double charge_ = 293;
  std::vector<double> ore_;  ///< all cells; empty: the guess counts
  std::vector<double> gas_;  ///< all cells
};

}  // namespace cupola
