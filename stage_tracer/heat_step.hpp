#pragma once
#include "stage_tracer/conduction.hpp"
#include "stage_tracer/exchange.hpp"
#include "stage_tracer/gas_model.hpp"
#include "stage_tracer/part_clock.hpp"
#include "stage_tracer/removal.hpp"
#include "stage_tracer/tracers.hpp"

namespace cupola {

/// Heat of one step: convection with the gas (Exchange), then conduction in the solids, both applied to the tracers
/// with the weights that made the cell sums, so that the tracers take exactly what gas and neighbours give.  A tracer
/// takes it as enthalpy: where heat capacities change with the temperature, or a species melts over a range, its new
/// temperature is that of its new enthalpy.
class HeatStep {
 public:
  /// @param clock counts the parts `exchange`, `gas energy` and `conduction`
  HeatStep(const Campaign& campaign, const CellSpreading& kernel, const Conduction& conduction, PartClock& clock)
      : campaign_(campaign), kernel_(kernel), conduction_(conduction), clock_(clock), exchange_(campaign, kernel) {}

  /// @param contents sums of all ranks where the tracers are (not spread); its temperatures follow the tracers'
  /// @param gas may be null: conduction alone
  /// @return J that the solids lost to the walls
  double advance(Tracers& tracers, CellContents& contents, const BySpecies& bed_volume, const BedState& bed,
                 GasModel* gas, double step);

  /// Time in which the tracers approach the gas, s: their heat capacity over their conductance in the last step, of
  /// `step` s; infinite without gas. @param contents as in `advance`
  [[nodiscard]] double relaxation_time(const CellContents& contents, double step) const;

  /// What the gas sees of the solids at rest (no step): for its first solution.
  [[nodiscard]] SolidsExchange solids_at_rest(const CellContents& contents, const BedState& bed, const GasModel& gas);

  /// Steady temperature of the tracers in stagnant cells, in balance with gas and neighbours (MODEL 12); others are
  /// held.
  /// @return largest change of a tracer's temperature on this rank, K
  double settle_stagnant(Tracers& tracers, const CellContents& contents, const BySpecies& bed_volume,
                         const std::vector<bool>& stagnant, const BedState& bed, const GasModel& gas) const;

  /// Largest Biot number of each species in the last step; zeros without gas.
  [[nodiscard]] const std::vector<double>& largest_biot() const { return largest_biot_; }

 private:
  const Campaign& campaign_;
  const CellSpreading& kernel_;
  const Conduction& conduction_;
  PartClock& clock_;
  Exchange exchange_;
  std::vector<double> largest_biot_ = std::vector<double>(campaign_.species.size(), 0.0);
};

/// Removes the tracers that have reached their melting temperature.
void remove_molten(Tracers& tracers, const Campaign& campaign, Tally& tally);

}  // namespace cupola
