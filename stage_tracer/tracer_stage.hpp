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

  /// What the step costs in accuracy, by step doubling (StepError): where a trial is due, steps of twice the length are
  /// made, and the state is as before; when the march gets there it is compared and, with `time_step: auto`, the step
  /// follows.
  void begin_trial();
  void judge_trial();
  [[nodiscard]] bool choose_step();
  /// The state of the march, to go back to.
  struct Snapshot;
  [[nodiscard]] Snapshot snapshot() const;
  void go_back_to(Snapshot kept);
  [[nodiscard]] SolidsState solids_now() const;
  void step();
  void advance(double seconds);
  [[nodiscard]] Motion::Moved move(double seconds);
  void displace_tracers(double seconds);
  void compose(const Stays& stays);
  void exchange_heat(Motion::Moved& moved);
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
  StepLimits limits_;
  CellSpreading kernel_;
  Conduction conduction_;
  Motion motion_;
  SumOverRanks sum_;
  std::vector<double> empty_share_;
  std::vector<bool> displaced_;  ///< cells whose tracers may be displaced

  // The state of the march.
  long step_ = 0;
  double now_ = 0;  ///< s, end of the last step
  SteadyWatch steady_;
  TimeSteps steps_;  ///< of the whole stage
  StepError step_error_;
  std::optional<StepTrial> trial_;  ///< under way
  long next_trial_ = 0;             ///< not before this step
  double early_difference_ = 0;     ///< of the trial
  std::int64_t held_back_ = 0;      ///< displacements of this rank's tracers not made because of walls
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
