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

/// Steady gas flow through the bed, an ideal gas, in the squared pressure psi = p^2/2:
///   div G = 0,  -grad psi = (R T / M) r(|G|) G  [darcy_forchheimer]
///                           + (p/e) (div(G u) - div(e mu grad u))  [navier_stokes],
/// r = drag resistance per superficial velocity [kg/m3/s] from closures/drag, u = G/(rho e) the interstitial velocity.
/// Mass flow, velocity or pressure are given at the inlets, pressure at the outlet; nothing flows through walls, which
/// slip.  Newton's method in the flux normal to each face, warm-started; multigrid.  Works in parallel; every array is
/// over all cells or faces and the same on every rank.
///
/// Left out: gravity on the gas, turbulence, dispersion.  In empty cells (freeboard) the resistance is floored at 1e-4
/// of the bed's mean, so that the matrix stays well conditioned: their pressure drop stays negligible.
class BedFlow {
 public:
  enum class Model { darcy_forchheimer, navier_stokes };
  virtual ~BedFlow();
  BedFlow(const BedFlow&) = delete;
  BedFlow& operator=(const BedFlow&) = delete;

  struct Result {
    int iterations = 0;
    int cycles = 0;  ///< multigrid cycles in all
    double change =
        0;  ///< of the last iteration: relative change of the face mass fluxes and of the pressure rise, the larger
    double mass_residual = 0;  ///< sum over cells of |div G| over the blast
  };
  /// Iterates until `change` falls below `tolerance`.  Whatever the tolerance, the fluxes conserve mass.
  /// @param gas_temperature total temperature, K, all cells
  /// @throws Failure diverged (names the cell; navier_stokes advises darcy_forchheimer), also for a cell without gas;
  /// wrong_input where gas flows out through an inlet that states its pressure
  Result solve(const BedState& bed, const std::vector<double>& gas_temperature, double tolerance, int most_iterations);

  [[nodiscard]] Model model() const;
  [[nodiscard]] const std::vector<double>& pressure() const;    ///< Pa, all cells
  [[nodiscard]] const std::vector<Vector3>& mass_flux() const;  ///< kg/m2/s, superficial, cell means, all cells
  /// Pa/m, all cells: surface integral of the discrete face pressures over the cell's volume, so that the sum over
  /// cells of volume x gradient is the integral over the boundary to round-off.
  [[nodiscard]] const std::vector<Vector3>& pressure_gradient() const;
  [[nodiscard]] const std::vector<double>& face_mass_flux() const;  ///< kg/s out of the owner, all faces
  [[nodiscard]] double inertia_over_drag_largest() const;           ///< largest cell value of the next
  /// |div(G u)| over the drag, a cell: what darcy_forchheimer leaves out; 0 in empty and in nearly stagnant cells.
  [[nodiscard]] const std::vector<double>& inertia_over_drag() const;

  /// The state an iteration starts from; kept and restored bit by bit.
  struct WarmStart {
    std::vector<double> squared_pressure;  ///< psi - psi at the outlet, Pa2, all cells
    std::vector<double> face_mass_flux;    ///< kg/s, all faces
  };
  [[nodiscard]] const WarmStart& warm_start() const;
  /// Pressure at the faces, Pa: with the warm start all that `restore` needs.
  [[nodiscard]] const std::vector<double>& face_pressure() const;
  /// @param face_pressure and @param inertia (over drag, all cells) of the flow that is restored
  void restore(WarmStart start, std::vector<double> face_pressure, std::vector<double> inertia);

  /// Gas in an inlet's opening at the mean pressure there, for the report and the choking check (MODEL 13).
  struct NamedInlet {
    std::string name;
    InletState state;
    double mass_flow = 0;         ///< kg/s
    double smallest_opening = 0;  ///< m2, that passes the flow at the largest Mach number allowed
  };
  [[nodiscard]] std::vector<NamedInlet> inlets() const;

 protected:
  /// @throws Failure wrong_input when the mesh lacks an inlet or the outlet
  BedFlow(FoamCase& foam, const BedMesh& mesh, const Campaign& campaign, Model model);

 private:
  Result iterate(const BedState& bed, const std::vector<double>& gas_temperature, double tolerance,
                 int most_iterations);

  struct State;
  std::unique_ptr<State> state_;
};

/// Darcy and Forchheimer's law: pressure gradient and drag in balance.
class DarcyForchheimer : public BedFlow {
 public:
  DarcyForchheimer(FoamCase& foam, const BedMesh& mesh, const Campaign& campaign)
      : BedFlow(foam, mesh, campaign, Model::darcy_forchheimer) {}
};

/// The steady compressible Navier-Stokes equations with drag: pressure and momentum in turns (a segregated iteration as
/// SIMPLE's: the momentum equation's own coefficient goes into the pressure equation, what comes from beside is that of
/// the iteration before), the drag implicit.  Started from the Darcy-Forchheimer field.  Densities are those of the
/// static temperature, T - u^2/(2 cp).
class NavierStokes : public BedFlow {
 public:
  NavierStokes(FoamCase& foam, const BedMesh& mesh, const Campaign& campaign)
      : BedFlow(foam, mesh, campaign, Model::navier_stokes) {}
};

/// Exchange with the solids, a cell: heat given to the gas = conductance x (T_solid_mean - T_gas), W/K, with the sums
/// already taken over solids (conductance, conductance x T_solid): arrays over all cells.
struct SolidsExchange {
  std::vector<double> conductance;              ///< W/K
  std::vector<double> conductance_temperature;  ///< W
};

/// Steady gas energy: div(G h(T)) = div(k_eff grad T) + exchange - wall loss, upwind; along its way through a cell the
/// gas approaches what it exchanges with exponentially (second order); inlets at their total temperature, zero gradient
/// at the outlet (also where gas flows back).  T is the total temperature: kinetic energy inside the bed counts as
/// heat. Wall loss h (T - T_wall) A on the wall faces, on the share of them that the campaign says.  Gauss-Seidel
/// sweeps in the order of falling pressure; OpenFOAM's solver where the gas goes in circles.  Solved until the balance
/// closes to 1e-11 of what comes in.
class GasEnergy {
 public:
  GasEnergy(FoamCase& foam, const BedMesh& mesh, const Campaign& campaign);
  ~GasEnergy();
  /// @return gas temperature, all cells: the mean in the cell, which the solids feel (also kept for the next warm
  /// start)
  /// @throws Failure diverged (names the cell), also for a cell without gas
  const std::vector<double>& solve(const BedFlow& flow, const BedState& bed, const SolidsExchange& exchange);
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
