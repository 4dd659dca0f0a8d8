#pragma once
#include <vector>

#include "physics/equations/cell_equation.hpp"
#include "physics/equations/face_geometry.hpp"
#include "physics/gas/bed_gas.hpp"
#include "physics/gas/openings.hpp"
#include "physics/projection/bed_state.hpp"

namespace cupola {

/// Transient flow of an ideal gas of given temperature through a moving bed (seed 001 eq. 7 and 8),
///   d(e rho)/dt + div G = 0,   G = e rho u,
///   dG/dt + div(G u) = -e grad p - e r (e u - e v) + div(e mu grad u),
/// e the void fraction, v the mean velocity of the solids, r the drag law's resistance at the slip e |u - v|.
///
/// Unknowns are the cells' pressures and the mass fluxes through the faces.  Pressure, drag and storage are implicit,
/// convection and shear explicit and upwind (so a step is limited by the gas's way through a cell, not by sound or by
/// drag); a step is corrected as a whole some times, as PIMPLE does, so that density and drag belong to its end.  Mass
/// is conserved to the tolerance of the pressure equation (1e-10 of what flows), momentum between gas and solids to
/// round-off: `drag` is the very term of the gas's equation.  Walls slip.  mu is the gas's own and, where one is given,
/// the eddy viscosity; no gravity on the gas.
///
/// Arrays are over all cells or faces and the same on every rank.
class TransientFlow {
 public:
  /// Gas at rest at the outlet's pressure. @param temperature K, all cells
  /// @throws Failure wrong_input when the mesh lacks an inlet or the outlet
  TransientFlow(FoamCase& foam, const BedMesh& mesh, const Campaign& campaign, const std::vector<double>& temperature);

  /// What the gas sees of the solids at the end of a step.
  struct Solids {
    const BedState& bed;
    const std::vector<double>& volume;     ///< m3 of material in each cell: no drag where there is none
    const std::vector<Vector3>& velocity;  ///< m/s, of the solids of each cell
  };

  /// Takes the void fraction as it is without pressing gas out or drawing it in: where the flow begins, and where
  /// parcels came or went.
  void take_void_fraction(const std::vector<double>& void_fraction);
  /// One step. @param temperature K, of the gas
  /// @throws Failure diverged (names the cell)
  void step(const Solids& solids, const std::vector<double>& temperature, double seconds);

  /// What turbulence adds to the gas's viscosity from the next step on, Pa s in each cell; laminar without it.
  void set_eddy_viscosity(std::vector<double> viscosity) { eddy_viscosity_ = std::move(viscosity); }

  /// s, in which the gas goes through the cell it enters and leaves fastest; infinity where it stands still.
  [[nodiscard]] double crossing_time() const;
  [[nodiscard]] const std::vector<double>& pressure() const { return pressure_; }            ///< Pa
  [[nodiscard]] const std::vector<Vector3>& pressure_gradient() const { return gradient_; }  ///< Pa/m
  [[nodiscard]] const std::vector<Vector3>& velocity() const { return velocity_; }           ///< u, interstitial, m/s
  [[nodiscard]] const std::vector<Vector3>& drag() const { return drag_; }  ///< N/m3 of cell, on the solids
  /// Cells of the last step in which eddies would exchange more than a step can follow.
  [[nodiscard]] std::int64_t cells_of_limited_shear() const { return shear_limited_; }
  /// Gas by volume of cell (void fraction x density) when the last step began and when it ended, kg/m3.
  [[nodiscard]] const std::vector<double>& gas_by_volume_before() const { return gas_by_volume_before_; }
  [[nodiscard]] std::vector<double> gas_by_volume() const;
  [[nodiscard]] const std::vector<double>& void_fraction() const { return void_fraction_; }
  [[nodiscard]] const std::vector<double>& face_mass_flux() const { return flux_; }  ///< kg/s out of the owner
  /// r of the last step: -grad p = r x superficial slip, kg/m3/s.
  [[nodiscard]] const std::vector<double>& resistance() const { return resistance_; }
  /// |what the gas's mass in the cells changed by - what flowed in| over what flowed in, of the last step.
  [[nodiscard]] double mass_residual() const { return mass_residual_; }
  /// What the solids gave to the gas in the last step, N, from the gas's side: its change of momentum less what
  /// convection, shear, pressure and the walls did.
  [[nodiscard]] Vector3 force_of_solids() const { return force_of_solids_; }
  /// Names, flows and states of the inlets, for the report.
  [[nodiscard]] std::vector<BedFlow::NamedInlet> inlets() const;

  /// All that the next step begins with.
  struct Memory {
    std::vector<double> pressure, face_mass_flux, void_fraction, gas_density, face_pressure;
  };
  [[nodiscard]] Memory memory() const;
  void restore(Memory memory);

 private:
  /// A face's law on one of its sides, the fall of pressure along the face's normal from or to the cell's centre:
  ///   inertia ((g - g0)/dt + convection . n) + resistance g - push, g the mass flux, kg/m2/s.
  struct Side {
    double inertia = 0;     ///< m: distance over void fraction
    double resistance = 0;  ///< m/s: distance x r over density
    double push = 0;        ///< Pa: of the solids' own motion
    double convection = 0;  ///< N/m3, along the normal
  };
  [[nodiscard]] Side side(const Solids& solids, std::int64_t cell, std::size_t face, double distance) const;
  [[nodiscard]] double fall(const Side& side, double flux, double flux_before, double seconds) const {
    return side.inertia * ((flux - flux_before) / seconds + side.convection) + side.resistance * flux - side.push;
  }
  [[nodiscard]] bool through_flow(std::size_t face) const {
    return mesh_.face_neighbour[face] >= 0 || openings_.holds_pressure(face);
  }
  void set_resistance(const Solids& solids, const std::vector<double>& temperature);
  /// What shear exchanges through the inner and periodic faces, kg/s, as far as a step of `seconds` can follow it.
  [[nodiscard]] std::vector<double> shear_exchange(const std::vector<double>& temperature, double seconds);
  /// div(G u) - div(e mu grad u) of each cell, N/m3.
  [[nodiscard]] std::vector<Vector3> convection(const std::vector<double>& temperature, double seconds);
  void set_velocity();
  /// Pressures and fluxes at the end of the step. @param gas_before kg in each cell  @param flux_before kg/s
  void correct(const Solids& solids, const std::vector<double>& temperature, const std::vector<double>& gas_before,
               const std::vector<double>& flux_before, double seconds);
  /// Pressures at the faces, the drag, and what the solids gave by the gas's own balance.
  void finish(const Solids& solids, const std::vector<double>& flux_before, double seconds);

  const BedMesh& mesh_;
  FaceGeometry geometry_;
  CellEquation equation_;
  const Campaign& campaign_;
  Openings openings_;
  double blast_ = 0;                   ///< kg/s, what flows, for the tolerances
  std::vector<double> pressure_;       ///< Pa
  std::vector<double> face_pressure_;  ///< Pa
  std::vector<double> flux_;           ///< kg/s out of the owner
  std::vector<double> void_fraction_;
  std::vector<double> density_;         ///< kg/m3
  std::vector<double> density_of_law_;  ///< kg/m3, that the faces' fluxes were found with: before the last correction
  std::vector<double> resistance_;      ///< r, kg/m3/s
  std::vector<double> oblique_;  ///< Pa, owner's and neighbour's part: what the pressure changes in the face's plane
  std::vector<double> eddy_viscosity_;        ///< Pa s; empty: laminar
  std::vector<double> gas_by_volume_before_;  ///< kg/m3
  std::int64_t shear_limited_ = 0;
  std::vector<Vector3> convection_, velocity_, gradient_, drag_;
  double mass_residual_ = 0;
  Vector3 force_of_solids_{};
};

}  // namespace cupola
