#pragma once
#include <optional>
#include <vector>

#include "physics/equations/cell_equation.hpp"
#include "physics/equations/closing_tree.hpp"
#include "physics/equations/face_geometry.hpp"
#include "physics/gas/bed_gas.hpp"
#include "physics/gas/drag_tangent.hpp"
#include "physics/gas/momentum.hpp"
#include "physics/gas/openings.hpp"

namespace cupola {

/// The state of a `BedFlow` and the steps of its iteration.
struct BedFlow::State {
  State(FoamCase& foam, const BedMesh& bed_mesh, const Campaign& campaign, Model which);

  /// Tangents of the drag law at the cells' mass fluxes; at the usual flux everywhere when there is none yet.
  void set_resistances(const BedState& bed);
  /// Inertia and viscosity at the present flow (navier_stokes).
  void set_momentum();
  /// Static temperature from the total one and the velocity (navier_stokes; else they are the same).
  void set_static_temperature(const std::vector<double>& total);
  /// One Newton step: the linearised law of every face, put into the mass balance.
  /// @param tolerance of the mass balance, over the blast  @return relative change
  double step(BedFlow::Result& result, double tolerance);
  /// Inlets that state a velocity follow the pressure.
  void follow_openings();
  /// What the inlets blow, by the present fluxes.
  void count_blast();
  /// Makes the mass fluxes of the last step conserve mass to round-off.
  void close_mass();
  void set_pressure();
  /// Pressures, and what is derived only where it is asked for.
  void finish(const BedState& bed, const std::vector<double>& gas_temperature);
  /// Pressure at faces, its gradient and what inertia is to drag, of the last solution.
  void derive();

  const BedMesh& mesh;
  FaceGeometry geometry;
  CellEquation equation;
  Gas gas;
  Model model;
  Openings openings;
  ClosingTree closing;
  DragTangents resistance;

  double blast = 0;       ///< kg/s
  double usual_flux = 0;  ///< kg/m2/s, blast over the outlet's area
  double psi_outlet = 0;  ///< Pa2

  bool cold = true;  ///< no mass fluxes known yet
  bool inertia_on = false;
  double relaxation = 1;  ///< of the velocity that the momentum terms are made of
  WarmStart start;
  std::vector<Vector3> mass_flux;
  std::vector<double> void_fraction, temperature;  ///< temperature: static, K
  std::int64_t too_fast = 0;                       ///< cells whose gas would need more than its heat to be so fast
  MomentumTerms momentum;
  std::vector<Vector3> carried_velocity;  ///< m/s, interstitial, relaxed

  struct Solved {
    BedState bed;
    std::vector<double> gas_temperature;
  };
  std::optional<Solved> solved_for;  ///< what the last solution was for, until its consequences are derived
  std::vector<double> pressure, face_pressure, inertia;
  std::vector<Vector3> gradient;
  double inertia_largest = 0;

 private:
  struct FaceLaw {
    DragTangents::Value drag;
    double push = 0;  ///< along the face's normal, Pa2/m
  };
  /// The law on the cell's side of a face: the normal flux is the face's, the tangential one the cell's (it jumps from
  /// layer to layer, the normal one does not).
  [[nodiscard]] FaceLaw at_face(std::int64_t cell, std::size_t face, double normal_flux) const;
  /// -grad psi of a cell by its own law along an offset in a face's plane.
  [[nodiscard]] double fall_along(std::int64_t cell, double law_value, const Vector3& offset) const;
  /// psi at the face as seen from one of its cells, from the cell's own law.
  [[nodiscard]] double psi_from(std::int64_t cell, const Vector3& offset, double normal_fall) const;
  [[nodiscard]] double psi_at_face(std::size_t face) const;
  /// Mean static pressure in each inlet's opening, Pa.
  [[nodiscard]] std::vector<double> inlet_pressure() const;
  [[nodiscard]] bool through_flow(std::size_t face) const {
    return mesh.face_neighbour[face] >= 0 || openings.holds_pressure(face);
  }
  void set_gradient();
  void set_inertia();
};

}  // namespace cupola
