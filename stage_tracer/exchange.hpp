#pragma once
#include <vector>

#include "physics/closures/gas_state.hpp"
#include "physics/gas/bed_gas.hpp"
#include "physics/projection/cell_spreading.hpp"
#include "stage_tracer/cell_contents.hpp"

namespace cupola {

/// Convective heat between gas and tracers over one step, the same on both sides.  In cell j all tracers of a species
/// share the rate
///   k = 6 / (d rho cp) sum_c W_cj h_c,
/// with the kernel W of CellSpreading, and feel the gas temperature T* = sum_c W_cj h_c T_c / sum_c W_cj h_c.  With T*
/// constant over the step a tracer goes exactly to T* + (T - T*) exp(-k dt); its mean conductance over the step is then
///   h A (1 - exp(-k dt))/(k dt),
/// which is what the gas energy is solved with: the gas gives exactly what the tracers take, for any step.
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
  void set_rates(const GasFields& gas, const CellContents& contents, double step);

  /// What the gas energy equation needs of the solids.
  [[nodiscard]] SolidsExchange solids(const CellContents& contents) const;

  /// T* of each species in each cell, K.
  [[nodiscard]] BySpecies felt_temperature(const std::vector<double>& gas_temperature) const;

  /// Heat transfer coefficient h, W/m2/K, [species][cell].
  [[nodiscard]] const BySpecies& coefficient() const { return coefficient_; }

  /// h as a tracer in each cell feels it, sum_c W_cj h_c, W/m2/K, [species][cell].
  [[nodiscard]] const BySpecies& felt_coefficient() const { return felt_; }

  /// exp(-k dt), [species][cell].
  [[nodiscard]] const BySpecies& decay() const { return decay_; }

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
  BySpecies decay_;
  BySpecies mean_decay_;
  std::vector<double> largest_biot_;
};

/// Apparent volumetric heat capacity of a species in each cell, J/m3/K, at its mean temperature there.
std::vector<double> volumetric_heat_capacity(const Species& species, const std::vector<double>& temperature);

}  // namespace cupola
