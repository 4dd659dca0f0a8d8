#pragma once
#include <string>
#include <vector>

#include "physics/closures/inlet.hpp"
#include "physics/equations/face_geometry.hpp"
#include "physics/mesh/bed_mesh.hpp"
#include "schemas/campaign.hpp"

namespace cupola {

/// The openings of the gas: what the campaign states of each, on the faces of the mesh.  A mass flow or a velocity
/// gives the faces' fluxes, shared by area; a pressure gives psi = p^2/2 there, as at the outlet.
class Openings {
 public:
  /// @throws Failure wrong_input when the mesh lacks an inlet or the outlet, or no inlet blows any gas
  Openings(const BedMesh& mesh, const FaceGeometry& geometry, const Gas& gas);

  [[nodiscard]] bool holds_pressure(std::size_t face) const { return kind_[face] == Kind::pressure; }
  [[nodiscard]] bool is_inlet(std::size_t face) const { return inlet_of_[face] >= 0; }
  /// psi - psi at the outlet, where `holds_pressure`, Pa2.
  [[nodiscard]] double psi(std::size_t face) const { return value_[face]; }
  /// kg/s out of the owner on faces of inlets with a mass flow or velocity; 0 on walls.
  [[nodiscard]] double flux(std::size_t face) const { return value_[face]; }

  /// Mass flow of the inlets that state a velocity, from the mean static pressure (Pa) in each opening.
  /// @throws Failure diverged where no such flow exists
  void follow_pressure(const std::vector<double>& pressure);

  /// Whether an inlet states its velocity.
  [[nodiscard]] bool state_velocity() const;
  /// kg/s through each inlet, from the fluxes of the faces.
  [[nodiscard]] std::vector<double> mass_flow(const std::vector<double>& face_mass_flux) const;
  /// Mean over each inlet's opening of a value on faces.
  [[nodiscard]] std::vector<double> mean(const std::vector<double>& face_value) const;
  /// State of an inlet's gas at a mass flow (kg/s) and a static pressure (Pa).
  [[nodiscard]] InletState state(std::size_t inlet, double mass_flow, double pressure) const;
  /// The opening that passes a mass flow at the largest Mach number allowed, m2.
  [[nodiscard]] double smallest_opening(std::size_t inlet, double mass_flow, double pressure) const;
  /// Inlet of a face, as in the campaign's list; -1 elsewhere.
  [[nodiscard]] int inlet_of(std::size_t face) const { return inlet_of_[face]; }
  [[nodiscard]] const std::vector<Inlet>& inlets() const { return gas_.inlets; }

  /// kg/s that all inlets together are expected to blow: stated, or a guess where pressures are stated.
  [[nodiscard]] double expected_blast() const { return expected_blast_; }
  [[nodiscard]] double outlet_area() const { return outlet_area_; }

 private:
  enum class Kind : char { closed, flux, pressure };
  void set_flux(std::size_t inlet, double mass_flow);

  const BedMesh& mesh_;
  const FaceGeometry& geometry_;
  Gas gas_;
  std::vector<Kind> kind_;
  std::vector<double> value_;
  std::vector<int> inlet_of_;
  std::vector<const BedMesh::Patch*> patch_;  ///< of each inlet
  std::vector<double> area_;                  ///< m2, of each inlet's faces
  std::vector<double> opening_;               ///< m2, of each inlet as the campaign has it
  double outlet_area_ = 0;
  double expected_blast_ = 0;
};

}  // namespace cupola
