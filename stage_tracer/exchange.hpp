#pragma once
#include <vector>

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
class Exchange {
 public:
  Exchange(const Campaign& campaign, const CellSpreading& kernel) : campaign_(campaign), kernel_(kernel) {}

  /// Rates of this step from the gas mass flux (kg/m2/s, all cells).
  void set_rates(const std::vector<Vector3>& mass_flux, double step);

  /// What the gas energy equation needs of the solids.
  [[nodiscard]] SolidsExchange solids(const CellContents& contents) const;

  /// T* of each species in each cell, K.
  [[nodiscard]] BySpecies felt_temperature(const std::vector<double>& gas_temperature) const;

  /// Heat transfer coefficient h, W/m2/K, [species][cell].
  [[nodiscard]] const BySpecies& coefficient() const { return coefficient_; }

  /// exp(-k dt), [species][cell].
  [[nodiscard]] const BySpecies& decay() const { return decay_; }

  /// (1 - exp(-x))/x, accurate for any x >= 0.
  static double mean_decay(double x);

 private:
  const Campaign& campaign_;
  const CellSpreading& kernel_;
  BySpecies coefficient_;  ///< h, W/m2/K
  BySpecies felt_;         ///< h as a tracer in the cell feels it, W/m2/K
  BySpecies decay_;
  BySpecies mean_decay_;
};

}  // namespace cupola
