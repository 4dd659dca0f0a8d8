#pragma once
#include <array>
#include <vector>

#include "stage_tracer/conduction.hpp"
#include "stage_tracer/exchange.hpp"
#include "stage_tracer/gas_model.hpp"
#include "stage_tracer/predictor/counter_flow_matrix.hpp"
#include "stage_tracer/predictor/solids_sweep.hpp"

namespace cupola {

/// Temperatures that determine each other: gas, and the mean of each species, K, all cells.
struct BedTemperatures {
  std::vector<double> gas;
  BySpecies solids;
};

/// Lowest and highest temperature of what enters a bed, K: no temperature can leave that range.
std::array<double, 2> temperature_range(const Campaign& campaign);

/// The steady heat balance of gas and solids on given streamlines, with given flow, composition and rates of exchange.
///
/// Unknown are the temperatures of the gas and of each species; one evaluation carries the solids down the streamlines
/// in that gas, with the conduction that those means cause, and solves the gas energy with the solids that come out.
/// Evaluations alone do not converge: counter-current flow passes a change back and forth.  So each difference is
/// turned into a correction by the upwind equations of all temperatures together (CounterFlowMatrix), and the
/// corrections are accelerated after Anderson.  What converges is the evaluation's fixed point: the upwind equations do
/// not enter it.
class SteadyHeat {
 public:
  /// Keeps references.
  SteadyHeat(const BedMesh& mesh, const Campaign& campaign, const CellSpreading& kernel, const Conduction& conduction,
             SumOverRanks sum)
      : mesh_(mesh), campaign_(campaign), kernel_(kernel), conduction_(conduction), sum_(std::move(sum)) {}

  /// What is held while the temperatures are sought.
  struct Bed {
    const GranularField& field;
    const std::vector<double>& packing;  ///< solids fraction, all cells, not 0
    const std::vector<double>& sink;     ///< of the persistent species, 1/s, all cells
    const Streamlines& lines;
    const BySpecies& volume;  ///< m3, [species][cell], of the composition
    const BedState& state;
    /// K/s by which the temperatures of each species still change, [species][cell]; null: steady
    const BySpecies* tendency = nullptr;
  };
  struct Result {
    SolidsOnLines solids;
    int evaluations = 0;
    int linear_iterations = 0;  ///< of all evaluations
    double correction = 0;      ///< K, rms of the last correction: about the error that is left
  };
  /// Improves the temperatures until the corrections are below `tolerance` (K, rms), or so often.
  Result solve(const Bed& bed, GasModel& gas, CellContents contents, BedTemperatures& temperatures, double tolerance,
               int most_evaluations);

 private:
  class Evaluation;

  const BedMesh& mesh_;
  const Campaign& campaign_;
  const CellSpreading& kernel_;
  const Conduction& conduction_;
  SumOverRanks sum_;
};

}  // namespace cupola
