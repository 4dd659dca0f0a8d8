#pragma once
#include <vector>

#include "physics/closures/gas_state.hpp"
#include "physics/gas/bed_gas.hpp"
#include "physics/projection/cell_spreading.hpp"
#include "stage_tracer/cell_contents.hpp"

namespace cupola {

/// Convective heat between gas and tracers, the same on both sides.  In cell j all tracers of a species share the rate
///   k_j = 6 / (d rho cp) sum_c W_cj h_c,
/// with the kernel W of CellSpreading, and feel the gas temperature T*_j = sum_c W_cj h_c T_c / sum_c W_cj h_c.  With
/// T* constant over the step a tracer goes exactly to T* + (T - T*) exp(-k dt) where it stays in one cell; its mean
/// conductance over the step is then h A (1 - exp(-k dt))/(k dt), which is what the gas energy is solved with: the gas
/// gives exactly what the tracers take, for any step.  HeatStep does the same along paths through several cells.
///
/// h is the campaign's convection law, with the gas's properties at its own temperature, and the intragrain resistance
/// where the campaign asks for it.  cp is the apparent heat capacity (latent heat included) at the mean temperature of
/// the species in the cell; the tracers are then heated by enthalpy (HeatStep), so that it only shapes the rate.
class Exchange {
 public:
  Exchange(const Campaign& campaign, const CellSpreading& kernel);

  /// The gas at the beginning of the step, all cells.
  struct GasFields {
    const std::vector<Vector3>& mass_flux;     ///< kg/m2/s
    const std::vector<double>& temperature;    ///< K
    const std::vector<double>& void_fraction;  ///< 1
  };
  /// Rates of this step. @param contents not spread
  void set_rates(const GasFields& gas, const CellContents& contents);

  /// What the gas energy equation needs of the solids: their mean conductance over a step, s, in which they stay in
  /// their cells.
  [[nodiscard]] SolidsExchange solids(const CellContents& contents, double step) const;

  /// The same from the conductances of the tracers in each cell, W/K, and these times the tracers' temperatures, W
  /// ([species][cell]): what a tracer in cell j gives comes from cells c in the proportions W_cj h_c.
  [[nodiscard]] SolidsExchange seen_by_gas(BySpecies conductance, BySpecies conductance_temperature) const;

  /// T* of each species in each cell, K.
  [[nodiscard]] BySpecies felt_temperature(const std::vector<double>& gas_temperature) const;

  /// Heat transfer coefficient h, W/m2/K, [species][cell].
  [[nodiscard]] const BySpecies& coefficient() const { return coefficient_; }

  /// h as a tracer in each cell feels it, sum_c W_cj h_c, W/m2/K, [species][cell].
  [[nodiscard]] const BySpecies& felt_coefficient() const { return felt_; }

  /// k, 1/s, [species][cell].
  [[nodiscard]] const BySpecies& rate() const { return rate_; }

  /// Largest Biot number of each species where it is, without the intragrain resistance (closures/biot.hpp).
  [[nodiscard]] const std::vector<double>& largest_biot() const { return largest_biot_; }

  /// (1 - exp(-x))/x, accurate for any x >= 0.
  static double mean_decay(double x);

 private:
  const Campaign& campaign_;
  const CellSpreading& kernel_;
  GasState gas_;
  BySpecies coefficient_;  ///< h, W/m2/K
  BySpecies felt_;         ///< h as a tracer in the cell feels it, W/m2/K
  BySpecies rate_;         ///< k, 1/s
  std::vector<double> largest_biot_;
};

/// Apparent volumetric heat capacity of a species in each cell, J/m3/K, at its mean temperature there.
std::vector<double> volumetric_heat_capacity(const Species& species, const std::vector<double>& temperature);

}  // namespace cupola
