#pragma once
#include <mpi.h>

#include <chrono>
#include <filesystem>
#include <optional>

#include "physics/mesh/foam_case.hpp"
#include "physics/plan/dem_time_step.hpp"
#include "physics/stage/checkpoint_files.hpp"
#include "physics/stage/process_start.hpp"
#include "physics/stage/stop_request.hpp"
#include "schemas/failure.hpp"
#include "schemas/task.hpp"
#include "stage_dem/batch_charging.hpp"
#include "stage_dem/bed_builder.hpp"
#include "stage_dem/dem_gas.hpp"
#include "stage_dem/dem_state.hpp"
#include "stage_dem/mass_books.hpp"
#include "stage_dem/ore_temperature.hpp"
#include "stage_dem/raceway_removal.hpp"
#include "stage_dem/window_averages.hpp"

namespace cupola {

/// The DEM stage of an episode (sections 2 and 3 of seed 001): seconds of coarse-grained CFD-DEM from a packing, or
/// from a bed it builds, to the averaged granular field and the last packing.  Cut into blocks; what happens between
/// two blocks is written in `finish_block`, the whole in `run`.
class DemStage {
 public:
  DemStage(const Task& task, const std::filesystem::path& folder, FoamCase& foam, const BedMesh& mesh,
           MPI_Comm communicator);

  /// Goes on from the last checkpoint where there is one. @return done, or stopped with a good checkpoint
  ExitCode run();

 private:
  friend class DemFiles;

  void begin();
  void begin_block();
  void advance_block();
  void finish_block();
  void next_phase();
  void enter(DemPhase phase);

  /// Whether the gas makes steps of its own within a block.
  [[nodiscard]] bool couples_within_blocks() const {
    return gas_ && campaign_.dem.gas == DemSettings::GasModel::transient;
  }

  void hold_dead_man(const std::vector<Parcel>& owned);
  void sample();
  void shrink_or_regrow();
  void remove_parcels();
  void charge();
  void watch();
  void report_progress(bool now);

  [[nodiscard]] bool moving() const {
    return state_.phase == DemPhase::relaxing || state_.phase == DemPhase::averaging;
  }
  /// Whether the bed has got over the new cohesive zone: after `dem.relaxation`, and, where the stage ends by the state
  /// of its fields, not before the bed's descent is stationary (as long as the window still fits in).
  [[nodiscard]] bool relaxed() const;
  [[nodiscard]] bool window_complete() const;
  [[nodiscard]] double temperature_at(const Parcel& parcel) const;
  [[nodiscard]] double wall_seconds() const;

  const Task& task_;
  const Campaign& campaign_;
  std::filesystem::path folder_;
  const BedMesh& mesh_;
  std::vector<bool> bed_;  ///< cells below the stock plane
  MPI_Comm communicator_;
  int rank_ = 0;
  int ranks_ = 1;
  std::chrono::steady_clock::time_point started_;
  std::chrono::steady_clock::time_point last_progress_;
  std::chrono::steady_clock::time_point last_checkpoint_;
  double progress_time_ = 0;
  double progress_wall_ = 0;

  StopRequest stop_request_;
  DemTimeStep step_;
  DemState state_;
  OreTemperature temperature_;
  SolidsOnMesh solids_;
  std::unique_ptr<DemGas> gas_;  ///< null: none
  BedBuilder builder_;
  BatchCharging charging_;
  RacewayRemoval raceways_;
  MassBooks books_;
  MassBooks books_at_window_;
  WindowAverages averages_;
  std::vector<WindowAverages> species_averages_;  ///< one a species; none where there is one species only
  std::unique_ptr<Engine> engine_;
  std::vector<Parcel> parcels_;  ///< all, after the last block
  bool regrowing_ = false;       ///< whether the last regrowth changed a radius
};

}  // namespace cupola
