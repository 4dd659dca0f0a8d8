#pragma once
#include "stage_dem/dem_stage.hpp"

namespace cupola {

/// What the DEM stage reads and writes: packing, checkpoints, result (docs/contracts.md).
class DemFiles {
 public:
  explicit DemFiles(DemStage& stage) : stage_(stage) {}

  /// Starts the engine, from a snapshot or empty.
  void make_engine(std::vector<std::uint8_t> snapshot);
  /// Restores everything from the last whole checkpoint. @return false where there is none
  bool resume();
  /// Starts from the packing of the episode before.
  void load_packing();

  void write_checkpoint();
  /// After the time between checkpoints: 300 s of wall time, or CUPOLA_CHECKPOINT_SECONDS of the environment.
  void write_checkpoint_when_due();

  void write_result();

 private:
  [[nodiscard]] nlohmann::json summary() const;
  void write_packing(HdfWriter& file) const;
  /// Mass charged in the averaging window over that of the whole recipe.
  [[nodiscard]] double layer_passages() const;

  DemStage& stage_;
};

}  // namespace cupola
