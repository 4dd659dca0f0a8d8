#pragma once
#include <memory>
#include <string>
#include <vector>

#include "physics/closures/inlet.hpp"
#include "physics/mesh/bed_mesh.hpp"
#include "physics/mesh/foam_case.hpp"
#include "physics/projection/bed_state.hpp"
#include "schemas/campaign.hpp"

namespace cupola {

/// Steady gas flow through the bed: the Darcy-Forchheimer equation in the squared pressure psi = p^2/2,
///   div G = 0,  -grad psi = (R T / M) r(|G|) G,  r = drag resistance per superficial velocity [kg/m3/s] from
///   closures/drag,
/// mass flow prescribed at the inlets, pressure at the outlet, no flow through walls.  Newton's method in the flux
/// normal to each face, warm-started; multigrid.  Works in parallel; every array is over all cells or faces and the
/// same on every rank.
///
/// Left out: inertia (reported as a ratio to drag), gravity on the gas, dispersion.  In empty cells (freeboard) the
/// resistance is floored at 1e-4 of the bed's mean, so that the matrix stays well conditioned: their pressure drop
/// stays negligible.
class DarcyForchheimer {
 public:
  /// @throws Failure wrong_input when the mesh lacks an inlet or the outlet
  DarcyForchheimer(FoamCase& foam, const BedMesh& mesh, const Campaign& campaign);
  ~DarcyForchheimer();

  struct Result {
    int iterations = 0;
    int cycles = 0;  ///< multigrid cycles in all
    double change =
        0;  ///< of the last iteration: relative change of the face mass fluxes and of the pressure rise, the larger
    double mass_residual = 0;  ///< sum over cells of |div G| over the blast
  };
  /// Iterates until `change` falls below `tolerance`.  Whatever the tolerance, the fluxes conserve mass.
  /// @throws Failure diverged (names the cell), also for a cell without gas
  Result solve(const BedState& bed, const std::vector<double>& gas_temperature, double tolerance, int most_iterations);

  [[nodiscard]] const std::vector<double>& pressure() const;    ///< Pa, all cells
  [[nodiscard]] const std::vector<Vector3>& mass_flux() const;  ///< kg/m2/s, superficial, cell means, all cells
  /// Pa/m, all cells: surface integral of the discrete face pressures over the cell's volume, so that the sum over
  /// cells of volume x gradient is the integral over the boundary to round-off.
  [[nodiscard]] const std::vector<Vector3>& pressure_gradient() const;
  [[nodiscard]] const std::vector<double>& face_mass_flux() const;  ///< kg/s out of the owner, all faces
  [[nodiscard]] double inertia_over_drag_largest() const;  ///< what the equation leaves out, largest cell value
  [[nodiscard]] const std::vector<double>& inertia_over_drag()
      const;  ///< the same a cell; 0 in empty and in nearly stagnant cells

  /// The state an iteration starts from; kept and restored bit by bit.
  struct WarmStart {
    std::vector<double> squared_pressure;  ///< psi - psi at the outlet, Pa2, all cells
    std::vector<double> face_mass_flux;    ///< kg/s, all faces
  };
  [[nodiscard]] const WarmStart& warm_start() const;
  void restore(WarmStart start);

  /// Gas in an inlet's opening at the mean pressure there, for the report and the choking check (MODEL 13).
  struct NamedInlet {
    std::string name;
    InletState state;
    double smallest_opening = 0;  ///< m2, that passes the flow at the largest Mach number allowed
  };
  [[nodiscard]] std::vector<NamedInlet> inlets() const;

 private:
  struct State;
  std::unique_ptr<State> state_;
};

/// Exchange with the solids, a cell: heat given to the gas = conductance x (T_solid_mean - T_gas), W/K, with the sums
/// already taken over solids (conductance, conductance x T_solid): arrays over all cells.
struct SolidsExchange {
  std::vector<double> conductance;              ///< W/K
  std::vector<double> conductance_temperature;  ///< W
};

/// Steady gas energy: div(G cp T) = div(k_eff grad T) + exchange - wall loss, upwind; along its way through a cell the
/// gas approaches what it exchanges with exponentially (second order); inlets at their total temperature, zero gradient
/// at the outlet (also where gas flows back).  T is the total temperature: kinetic energy
/// inside the bed is left out. Wall loss h (T - T_wall) A on the wall faces.  The linear system is solved until the
/// balance closes to 1e-11 of what comes in.
class GasEnergy {
 public:
  GasEnergy(FoamCase& foam, const BedMesh& mesh, const Campaign& campaign);
  ~GasEnergy();
  /// @return gas temperature, all cells: the mean in the cell, which the solids feel (also kept for the next warm
  /// start)
  /// @throws Failure diverged (names the cell), also for a cell without gas
  const std::vector<double>& solve(const DarcyForchheimer& flow, const BedState& bed, const SolidsExchange& exchange);
  [[nodiscard]] const std::vector<double>& temperature() const;
  void restore(const std::vector<double>& temperature);
  /// W, enthalpies from 293 K; blast = top_gas + walls + to_solids to the tolerance, from the terms of the discrete
  /// equation.
  struct Ledger {
    double blast = 0, top_gas = 0, walls = 0, to_solids = 0;
    double top_gas_temperature = 293;  ///< K, mean of the outflow by mass
    double residual = 0;               ///< (blast - top_gas - walls - to_solids) / what comes in
  };
  [[nodiscard]] const Ledger& ledger() const;  ///< of the last solution

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace cupola
