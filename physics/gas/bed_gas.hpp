#pragma once
#include <memory>
#include <vector>

#include "physics/mesh/bed_mesh.hpp"
#include "physics/mesh/foam_case.hpp"
#include "schemas/campaign.hpp"

namespace cupola {

/// What the gas sees of the bed: arrays over all cells (BedMesh order), the same on every rank.
struct BedState {
  std::vector<double> void_fraction;      ///< of the gas, floored already (projection/void_fraction.hpp)
  std::vector<double> grain_diameter;     ///< m, Sauter mean of the unsoftened grains
  std::vector<double> polydispersity;     ///< factor of the drag law on the mean grain (1 for one species; see closures/drag)
};

/// Steady gas flow through the bed: the Darcy-Forchheimer equation in the squared pressure psi = p^2/2,
///   div G = 0,  -grad psi = (R T / M) r(|G|) G,  r = drag resistance per superficial velocity [kg/m3/s] from closures/drag,
/// mass flow prescribed at the inlets, pressure at the outlet; Picard iterations, warm-started; GAMG.  Works in parallel.
class DarcyForchheimer {
 public:
  DarcyForchheimer(FoamCase& foam, const BedMesh& mesh, const Campaign& campaign);
  ~DarcyForchheimer();

  struct Result { int iterations = 0; double change = 0; };
  /// Iterates until the relative change of the face mass fluxes falls below `tolerance`.
  /// @throws Failure diverged (names the cell)
  Result solve(const BedState& bed, const std::vector<double>& gas_temperature, double tolerance, int most_iterations);

  [[nodiscard]] const std::vector<double>& pressure() const;               ///< Pa, all cells
  [[nodiscard]] const std::vector<Vector3>& mass_flux() const;             ///< kg/m2/s, cell means, all cells
  [[nodiscard]] const std::vector<Vector3>& pressure_gradient() const;     ///< Pa/m, all cells, consistent with the discrete equation
  [[nodiscard]] double inertia_over_drag_largest() const;                  ///< what the equation leaves out, largest cell value
  void restore(const std::vector<double>& pressure);                       ///< warm start from a checkpoint or an earlier result

  struct Fluxes;                                                           ///< face mass fluxes on the decomposed mesh
  [[nodiscard]] const Fluxes& fluxes() const;

 private:
  struct State;
  std::unique_ptr<State> state_;
};

/// Exchange with the solids, a cell: heat given to the gas = conductance x (T_solid_mean - T_gas), W/K, with the sums already
/// taken over solids (conductance, conductance x T_solid): arrays over all cells.
struct SolidsExchange {
  std::vector<double> conductance;                ///< W/K
  std::vector<double> conductance_temperature;    ///< W
};

/// Steady gas energy: div(G cp T) = div(k_eff grad T) + exchange - wall loss, upwind, inlets at their total temperature.
class GasEnergy {
 public:
  GasEnergy(FoamCase& foam, const BedMesh& mesh, const Campaign& campaign);
  ~GasEnergy();
  /// @return gas temperature, all cells (also kept for the next warm start)
  const std::vector<double>& solve(const DarcyForchheimer& flow, const BedState& bed, const SolidsExchange& exchange);
  [[nodiscard]] const std::vector<double>& temperature() const;
  void restore(const std::vector<double>& temperature);
  struct Ledger { double blast = 0, top_gas = 0, walls = 0, to_solids = 0, top_gas_temperature = 0; };  ///< W, from 293 K
  [[nodiscard]] const Ledger& ledger() const;   ///< of the last solution

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace cupola
