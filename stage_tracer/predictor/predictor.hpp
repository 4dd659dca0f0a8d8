#pragma once
#include <array>
#include <chrono>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "physics/mesh/foam_case.hpp"
#include "schemas/failure.hpp"
#include "schemas/task.hpp"
#include "stage_tracer/part_clock.hpp"
#include "stage_tracer/predictor/predicted_field.hpp"
#include "stage_tracer/predictor/steady_heat.hpp"
#include "stage_tracer/result.hpp"

namespace cupola {

/// The steady state of a campaign without marching: granular flux, streamlines, composition, gas flow and temperatures
/// in turns until they agree (docs/predictor.md).
class Predictor {
 public:
  /// @param dem may be null  @param dem_temperature K, what that DEM stage softened and melted by
  /// @throws Failure wrong_input: nothing that this can predict
  Predictor(FoamCase& foam, const BedMesh& mesh, const Campaign& campaign, const DemResult* dem,
            const std::vector<double>& dem_temperature);

  struct Settings {
    double tolerance = 0.5;  ///< K, rms change of an iteration
    /// The same over rms(T - 293 K) once the lines are held: their jumps were larger than this.
    double held_tolerance = 0.002;
    int most_iterations = 40;
    std::array<int, 2> lines_across{4, 2};  ///< streamlines along each stock face in x and in y
    /// f, all cells: the flux and its lines follow this one and stay. Null: they follow the zone.
    const std::vector<double>* share = nullptr;
    /// K/s by which each species' temperature changes, [species][cell]. Null: the steady state.
    const BySpecies* tendency = nullptr;
  };
  /// One outer iteration, for the report.
  struct Iteration {
    double change = 0;      ///< K, rms of gas and solids
    double correction = 0;  ///< K, left in the temperatures on fixed streamlines
    int evaluations = 0;
    int linear_iterations = 0;
    double zone_height = 0;  ///< m, mean; NaN without one
    bool lines_moved = true;
  };
  struct Outcome {
    bool converged = false;
    std::vector<Iteration> iterations;
    std::vector<std::string> warnings;
    double reached = 0;  ///< share of the bed's volume that streamlines reach
    /// K, by which temperatures still jumped with the lines' passing from cell to cell when the lines were held; 0
    /// where they came to rest by themselves.
    double line_noise = 0;
  };
  /// @param temperatures where to begin
  Outcome solve(BedTemperatures temperatures, const Settings& settings, PartClock& clock);

  [[nodiscard]] const GranularField& field() const { return granular_.field(); }
  /// f, all cells, that flux and storage follow.
  [[nodiscard]] const std::vector<double>& share() const { return share_; }
  [[nodiscard]] const BedTemperatures& temperatures() const { return temperatures_; }
  [[nodiscard]] const CellSpreading& kernel() const { return kernel_; }
  [[nodiscard]] const CellContents& contents() const { return solids_.contents; }
  /// As the tracer stage's, of one second of the steady state; nothing is stored.
  [[nodiscard]] Ledger ledger() const;
  [[nodiscard]] const GasModel& gas() const { return gas_; }
  /// For `write_result`; averages and ledger must outlive it. @param started when the task began
  [[nodiscard]] MarchOutcome march_outcome(const Averages& averages, const Ledger& ledger,
                                           std::chrono::steady_clock::time_point started, const PartClock& clock) const;

 private:
  void compose(const CellContents& contents);
  void draw_lines(const std::vector<double>& share, const Settings& settings, std::optional<Streamlines>& lines,
                  PartClock& clock);
  [[nodiscard]] CellContents guessed_contents(const std::vector<double>& ore_temperature) const;
  /// Of the solids as they stand; without softening an ore as cold as the charge, and no zone.
  [[nodiscard]] MeltingZone melting_zone() const;
  /// The persistent species' share of the solids flux that the solids on the lines stand for.
  [[nodiscard]] std::vector<double> implied_share(const MeltingZone& zone) const;
  void check_raceways() const;
  void look_for_warnings(const MeltingZone& zone, Outcome& outcome) const;

  FoamCase& foam_;
  const BedMesh& mesh_;
  const Campaign& campaign_;
  PredictedField granular_;
  CellSpreading kernel_;
  Conduction conduction_;
  SteadyHeat heat_;
  GasModel gas_;
  std::vector<double> empty_share_;
  std::vector<double> share_;
  BedTemperatures temperatures_;
  SolidsOnLines solids_;
  BySpecies bed_volume_;
  BedState bed_;
};

/// Makes the prediction of a task of kind `predict` and writes its `result.hdf`. Every rank runs it.
/// @throws Failure
ExitCode predict(FoamCase& foam, const std::filesystem::path& folder, const Task& task);

/// Corrects the prediction of a task of kind `correct` by what the march that began with it has measured, and writes
/// `result.hdf`. Every rank runs it. @throws Failure
ExitCode correct(FoamCase& foam, const std::filesystem::path& folder, const Task& task);

}  // namespace cupola
