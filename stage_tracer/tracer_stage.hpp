#pragma once
#include <chrono>
#include <filesystem>
#include <memory>
#include <optional>

#include "physics/mesh/cell_locator.hpp"
#include "physics/mesh/foam_case.hpp"
#include "physics/stage/checkpoint_files.hpp"
#include "physics/stage/process_start.hpp"
#include "schemas/failure.hpp"
#include "schemas/task.hpp"
#include "stage_tracer/averages.hpp"
#include "stage_tracer/bed_composition.hpp"
#include "stage_tracer/dem_result.hpp"
#include "stage_tracer/heat_step.hpp"
#include "stage_tracer/insertion.hpp"
#include "stage_tracer/ledger.hpp"
#include "stage_tracer/make_granular_field.hpp"
#include "stage_tracer/march_windows.hpp"
#include "stage_tracer/motion.hpp"
#include "stage_tracer/part_clock.hpp"
#include "stage_tracer/previous_temperature.hpp"
#include "stage_tracer/result.hpp"
#include "stage_tracer/steady_watch.hpp"
#include "stage_tracer/step_error.hpp"
#include "stage_tracer/time_step.hpp"

namespace cupola {

/// Stage 2: tracers follow the averaged granular field for hours of process time, exchange heat with a quasi-steady
/// gas, are charged at the stock plane, melt, and are removed in the raceways.  One object marches one task; every rank
/// runs it.
class TracerStage {
 public:
  /// Reads the task's inputs and prepares the march. @throws Failure
  TracerStage(FoamCase& foam, std::filesystem::path folder, const Task& task);

  /// Marches from the last checkpoint or the beginning. @return done, or stopped (with a checkpoint)
  ExitCode run();

 private:
  void begin();
  void resume(const std::filesystem::path& checkpoint);
  void write_checkpoint();
  void write_state(HdfWriter& file, const std::vector<double>& all_tracer_rows) const;
  void read_state(const HdfReader& file);

  /// What the step costs in accuracy, by step doubling.
  void estimate_error();
  /// Difference of the tracers' temperatures after two steps and after one of twice the length; the state stays.
  [[nodiscard]] double compare_steps();
  void save_trial() const;
  void step();
  void advance(double seconds);
  void move(double to);
  void displace_tracers(double seconds);
  void compose();
  void exchange_heat(double seconds);
  void begin_gas();
  void average(double seconds);
  [[nodiscard]] bool is_steady();
  /// Ends a window of a march that measures a prediction.
  void end_window();
  void close_balances();
  void write_output(bool checkpoint_now, bool last);
  [[nodiscard]] nlohmann::json history_line() const;
  [[nodiscard]] MarchOutcome outcome();

  /// Length of the windows that means are taken over: one layer passage.
  [[nodiscard]] double window() const;
  [[nodiscard]] double wall_seconds() const;

  FoamCase& foam_;
  std::filesystem::path folder_;
  const Task& task_;
  const Campaign& campaign_;
  CheckpointFiles checkpoints_;
  std::chrono::steady_clock::time_point started_ = process_start();
  PartClock clock_;

  // What does not change during the march.
  BedMesh mesh_;
  CellLocator locator_;
  DemResult dem_;
  PreviousTemperature previous_;
  GranularField field_;
  PathField paths_;
  int split_;                                 ///< tracers a parcel
  std::unique_ptr<const ChargePlan> charge_;  ///< null for a bed at rest
  TimeSteps steps_;                           ///< of the whole stage
  CellSpreading kernel_;
  Conduction conduction_;
  Motion motion_;
  SumOverRanks sum_;
  std::vector<double> empty_share_;
  std::vector<bool> displaced_;  ///< cells whose tracers may be displaced

  // The state of the march.
  long step_ = 0;
  double now_ = 0;           ///< s, end of the last step
  double positions_at_ = 0;  ///< s, time the tracers' positions belong to: the middle of the last step
  SteadyWatch steady_;
  StepError step_error_;
  double error_memory_ = 0;     ///< s, for how long the tracers remember what was wrong in a step
  std::int64_t held_back_ = 0;  ///< displacements of this rank's tracers not made because of walls
  Tracers tracers_;
  std::unique_ptr<Insertion> insertion_;  ///< null for a bed at rest
  Ledger ledger_;
  Tally local_tally_;            ///< of this rank since the ledger was last closed
  std::size_t all_tracers_ = 0;  ///< of all ranks
  Averages averages_;
  std::optional<MarchWindows> windows_;  ///< of a march that began with a prediction
  std::unique_ptr<GasModel> gas_;        ///< null without gas
  std::int64_t cells_at_floor_ = 0;      ///< of the void fraction, largest so far
  double wall_before_ = 0;               ///< s, of earlier starts of this task

  double last_checkpoint_ = 0;  ///< s of wall time
  double last_progress_ = 0;
  double last_progress_time_ = 0;  ///< s of process time

  // Remade in every step.
  HeatStep heat_;
  CellContents contents_;
  BySpecies bed_volume_;
  BedState bed_;
};

}  // namespace cupola
