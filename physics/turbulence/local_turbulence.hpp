#pragma once
#include <string>
#include <vector>

namespace Foam {
class fvMesh;
}

namespace cupola {

/// A turbulence model on one rank's part of the mesh: what stands between the program and the module that brings
/// OpenFOAM's turbulence models along (`turbulence_module.cpp`), so that programs without turbulence do without it.
class LocalTurbulence {
 public:
  /// The gas at the end of a step.  Arrays over the rank's cells and faces (OpenFOAM's order), SI.
  struct Gas {
    std::vector<double> density_before;  ///< kg of gas by m3 of cell when the step began
    std::vector<double> density;         ///< kg of gas by m3 of cell: void fraction x density
    std::vector<double> viscosity;       ///< Pa s, of the gas, x void fraction
    std::vector<double> damping;         ///< kg/m3/s, drag by volume of cell over the slip
    std::vector<double> velocity;        ///< m/s, interstitial, cells x 3
    std::vector<double> mass_flux;       ///< kg/s through the faces, out of their owners
  };
  struct Fields {
    std::vector<double> k, epsilon;  ///< m2/s2, m2/s3
  };
  struct Inlet {
    std::string name;          ///< of the patch
    double intensity = 0;      ///< fluctuations over the velocity
    double mixing_length = 0;  ///< m
  };

  LocalTurbulence() = default;
  LocalTurbulence(const LocalTurbulence&) = delete;
  LocalTurbulence& operator=(const LocalTurbulence&) = delete;
  virtual ~LocalTurbulence() = default;

  virtual void step(const Gas& gas, double seconds) = 0;
  virtual Fields fields() const = 0;
  virtual void set_fields(const Fields& fields) = 0;
  /// After a step: what the next one would have found.
  virtual void restore(const Gas& gas, const Fields& fields) = 0;
  virtual std::vector<double> eddy_viscosity() const = 0;  ///< m2/s, kinematic
};

/// What the module exports under the name `cupola_make_turbulence`: the model of the case's turbulenceProperties.
/// Throws what OpenFOAM throws.
using MakeTurbulence = LocalTurbulence* (*)(Foam::fvMesh& mesh, const std::string& model,
                                            const std::vector<LocalTurbulence::Inlet>& inlets);

}  // namespace cupola
