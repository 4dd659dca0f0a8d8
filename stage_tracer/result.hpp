#pragma once
#include <filesystem>
#include <map>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

#include "schemas/task.hpp"
#include "stage_tracer/averages.hpp"
#include "stage_tracer/cohesive_zone.hpp"
#include "stage_tracer/gas_model.hpp"
#include "stage_tracer/granular_field.hpp"
#include "stage_tracer/ledger.hpp"
#include "stage_tracer/march_windows.hpp"
#include "stage_tracer/steady_watch.hpp"
#include "stage_tracer/tracers.hpp"

namespace cupola {

/// Where the melting species are and how hot they are, over the whole bed.
struct MeltingZone {
  std::vector<double> ore_temperature;  ///< K, all cells, continued (MODEL 11)
  std::vector<Column> columns;
  Isotherm melted;
  Isotherm softened;
};

/// @param volume, temperature spread contents or means, [species][cell]
/// @throws std::logic_error without a softening species
MeltingZone find_melting_zone(const BedMesh& mesh, const Campaign& campaign, const GranularField& field,
                              const BySpecies& volume, const BySpecies& temperature);

/// Whether a campaign has a species that softens and heat to soften it.
bool can_melt(const Campaign& campaign);

/// What a march leaves behind, for `result.hdf`.
struct MarchOutcome {
  const BedMesh& mesh;
  const GranularField& field;
  const Averages& averages;
  const Ledger& ledger;
  const GasModel* gas = nullptr;           ///< null without gas
  std::vector<double> tracer_rows{};       ///< of all ranks (to_rows), on rank 0
  std::vector<Vector3> tracer_position{};  ///< of the rows
  std::size_t tracers = 0;
  int ranks = 1;
  long steps = 0;
  double time_step = 0;
  double process_seconds = 0;
  double wall_seconds = 0;
  std::map<std::string, double> wall_seconds_by_part{};
  double motion_imbalance = 1;  ///< largest over mean time of the ranks in moving tracers
  std::int64_t cells_at_floor = 0;
  std::vector<double> largest_biot{};     ///< of each species, in the last step
  nlohmann::json gas_comparison{};        ///< of both gas models, where asked for
  nlohmann::json prediction{};            ///< of a prediction: how it came about; null for a march
  nlohmann::json correction{};            ///< of a corrected prediction: what the march has measured
  std::vector<double> ore_temperature{};  ///< K, all cells, instead of what the means say; empty: that
  std::map<std::string, std::vector<double>> more_cell_data{};  ///< fields by name, written as they are
  const MarchWindows* measured = nullptr;  ///< means over the layer passages of a march that began with a prediction
  std::optional<double> step_error{};      ///< estimated error of the temperatures from the time step; with heat
  bool until_steady = false;
  std::optional<RemainingChange> remaining{};  ///< of a march until steady, where it is known
  std::size_t windows = 0;                     ///< of it
  std::optional<std::int64_t> held_back{};     ///< displacements not made because of walls
};

/// Writes `result.hdf` of the task folder as docs/contracts.md has it.
void write_result(const std::filesystem::path& folder, const Task& task, const MarchOutcome& outcome);

}  // namespace cupola
