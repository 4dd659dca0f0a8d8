#pragma once
#include <memory>
#include <vector>

#include "physics/gas/transient_flow.hpp"
#include "physics/turbulence/local_turbulence.hpp"

namespace cupola {

/// `dem.transient.turbulence`: OpenFOAM's k-epsilon models (standard, RNG, realizable, with their own constants) on the
/// gas of `TransientFlow`, solved after each of its steps for the gas in the voids:
///   d(e rho k)/dt + div(G k) - div(e (mu + mu_t/sigma_k) grad k) = e G_k - 2/3 e rho k div u - e rho epsilon - 2 b k,
/// and epsilon likewise, u the interstitial velocity.  Grains do not follow the fluctuations: the drag b = e^2 r (by
/// volume of cell over the slip) damps them, and 1.2 epsilon/k of what it takes from k it takes from epsilon (Simonin
/// and Viollet 1990); what their wakes make is left out.  Walls slip, as
/// for the flow; at inlets k = 3/2 (0.05 u)^2, epsilon = 0.09^(3/4) k^(3/2)/l, l = 0.07 hydraulic diameters of the
/// opening.  The first state is that of the inlets at the speed of the blast.
/// Arrays are over all cells, the same on every rank.
class Turbulence {
 public:
  /// Loads the module that brings OpenFOAM's models along, from beside the program.
  /// @throws Failure input_output where it is not there, or where OpenFOAM cannot make the model
  Turbulence(FoamCase& foam, const BedMesh& mesh, const Campaign& campaign);
  ~Turbulence();
  Turbulence(const Turbulence&) = delete;
  Turbulence& operator=(const Turbulence&) = delete;

  /// Follows the last step of the flow. @param temperature K  @throws Failure diverged
  void step(const TransientFlow& flow, const std::vector<double>& temperature, double seconds);

  [[nodiscard]] const std::vector<double>& k() const { return k_; }              ///< m2/s2
  [[nodiscard]] const std::vector<double>& epsilon() const { return epsilon_; }  ///< m2/s3
  /// Pa s, of the gas (not by volume of cell).
  [[nodiscard]] const std::vector<double>& eddy_viscosity() const { return eddy_viscosity_; }
  void set_fields(const std::vector<double>& k, const std::vector<double>& epsilon);
  /// As it was after the step that `flow` has made last.
  void restore(const TransientFlow& flow, const std::vector<double>& temperature, const std::vector<double>& k,
               const std::vector<double>& epsilon, std::vector<double> eddy_viscosity);

 private:
  [[nodiscard]] LocalTurbulence::Gas local_gas(const TransientFlow& flow, const std::vector<double>& before,
                                               const std::vector<double>& temperature) const;

  FoamCase& foam_;
  const BedMesh& mesh_;
  const Gas& gas_;
  std::unique_ptr<LocalTurbulence> model_;
  std::vector<double> k_, epsilon_, eddy_viscosity_;
};

/// The turbulence a campaign asks for; null for a laminar gas.
std::unique_ptr<Turbulence> make_turbulence(FoamCase& foam, const BedMesh& mesh, const Campaign& campaign);

}  // namespace cupola
