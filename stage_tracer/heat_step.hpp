#pragma once
#include "stage_tracer/conduction.hpp"
#include "stage_tracer/exchange.hpp"
#include "stage_tracer/gas_model.hpp"
#include "stage_tracer/part_clock.hpp"
#include "stage_tracer/stays.hpp"

namespace cupola {

/// Heat of one step: convection with the gas (Exchange), then conduction in the solids, both applied to the tracers
/// with the weights that made the cell sums, so that the tracers take exactly what gas and neighbours give.
///
/// A tracer feels the gas of all cells on its path (Stays), one after the other, each for as long as it is there: with
/// the gas steady over the step, its rate k_j and felt temperature T*_j in the stay j of length t_j,
///   T' = T + sum_j a_j (T*_j - T),  a_j = (1 - exp(-k_j t_j)) exp(-sum of k t of later stays),
/// which is exact, and linear in the gas temperatures: the gas is solved with the conductance C a_j/dt, C the tracer's
/// heat capacity.  So what it feels does not jump where it crosses from cell to cell, and is of second order in dt.
///
/// Conduction is solved for the cells' means of the temperatures to which convection has brought the tracers; each
/// takes the changes of the cells on its path in the proportions of its stays, damped where more is conducted in a step
/// than a place holds (Conduction::Result).
///
/// A tracer takes heat as enthalpy: where heat capacities change with the temperature, or a species melts over a range,
/// its new temperature is that of its new enthalpy.  It melts at the end of the step nearest to its melting
/// temperature, half of a step's rise early or late.
class HeatStep {
 public:
  /// @param clock counts the parts `exchange`, `exchange on cells`, `gas energy` and `conduction`
  HeatStep(const Campaign& campaign, const CellSpreading& kernel, const Conduction& conduction, SumOverRanks sum,
           PartClock& clock);

  /// @param contents means of all ranks over the step where the tracers are (sum_stays; not spread); in the end its
  /// temperatures are means over the step
  /// @param gas may be null: conduction alone
  /// @param leaving gets those that melt
  /// @return J that the solids lost to the walls
  double advance(Tracers& tracers, const Stays& stays, CellContents& contents, const BySpecies& bed_volume,
                 const BedState& bed, GasModel* gas, Leaving& leaving);

  /// Time in which the tracers approach the gas, s: their heat capacity over their conductance in the last step;
  /// infinite without gas. @param contents as in `advance`
  [[nodiscard]] double relaxation_time(const CellContents& contents) const;

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
  /// Solves the gas; sets what each tracer takes of it and the cells' means of the temperatures to which it does.
  /// @param capacity J/m3/K, [species][cell]
  void convect(const Tracers& tracers, const Stays& stays, CellContents& contents, const BedState& bed, GasModel& gas,
               const BySpecies& capacity);
  /// @return as a tracer in each cell feels it: it changes by change - damping x its own temperature
  [[nodiscard]] Conduction::Result conduct(const CellContents& contents, const BySpecies& bed_volume,
                                           const BySpecies& capacity, double step) const;
  /// Sets the a_j of all stays, and sums V a_j and V a_j T of all ranks in each cell, [species][cell].
  void take_along_paths(const Tracers& tracers, const Stays& stays, BySpecies& taken, BySpecies& taken_temperature);
  void convect_along_paths(const Tracers& tracers, const Stays& stays, const BySpecies& capacity, const BySpecies& felt,
                           CellContents& contents);

  const Campaign& campaign_;
  const CellSpreading& kernel_;
  const Conduction& conduction_;
  SumOverRanks sum_;
  PartClock& clock_;
  Exchange exchange_;
  std::vector<double> constant_capacity_;  ///< J/m3/K, of each species; 0 where it changes with the temperature
  std::vector<double> approach_;           ///< a_j of the stays of the step
  struct Convected {
    double heat;         ///< J/m3
    double temperature;  ///< K, with it
  };
  std::vector<Convected> convected_;  ///< of each tracer in the step
  std::vector<double> largest_biot_ = std::vector<double>(campaign_.species.size(), 0.0);
};

}  // namespace cupola
