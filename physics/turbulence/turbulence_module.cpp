// OpenFOAM's k-epsilon models on the gas between grains: single-phase compressible models whose density is that by
// volume of cell, e rho, so that storage, convection and diffusion are those of the gas in the voids.
#include <CompressibleTurbulenceModel.H>
#include <RASModel.H>
#include <RNGkEpsilon.H>
#include <Time.H>
#include <fvMesh.H>
#include <fvm.H>
#include <kEpsilon.H>
#include <makeTurbulenceModel.H>
#include <realizableKE.H>
#include <surfaceFields.H>
#include <volFields.H>
#include <zeroGradientFvPatchFields.H>

#include <cmath>
#include <memory>

#include "physics/turbulence/local_turbulence.hpp"

namespace Foam {

/// Viscosity of the gas by volume of cell, as OpenFOAM's models ask for it.
class bedGas {
 public:
  bedGas(const volScalarField& viscosity, const volScalarField& density, const volScalarField& damping)
      : mu_(viscosity), rho_(density), damping_(damping) {}
  /// Drag by volume of cell over the slip of gas and grains, kg/m3/s.
  [[nodiscard]] const volScalarField& damping() const { return damping_; }
  [[nodiscard]] tmp<volScalarField> mu() const { return mu_; }
  [[nodiscard]] tmp<scalarField> mu(const label patch) const { return mu_.boundaryField()[patch]; }
  [[nodiscard]] tmp<volScalarField> nu() const { return mu_ / rho_; }
  [[nodiscard]] tmp<scalarField> nu(const label patch) const {
    return mu_.boundaryField()[patch] / rho_.boundaryField()[patch];
  }

 private:
  const volScalarField& mu_;
  const volScalarField& rho_;
  const volScalarField& damping_;
};

using bedGasTurbulence = CompressibleTurbulenceModel<bedGas>;
using bedGasRAS = RASModel<bedGasTurbulence>;

/// A k-epsilon model between grains, which do not follow the fluctuations: drag takes 2 b k from k and, as Simonin and
/// Viollet (1990) have it, 1.2 epsilon/k of that from epsilon.
template <typename Model>
class AmongGrains final : public Model {
 public:
  using Model::Model;

 protected:
  tmp<fvScalarMatrix> kSource() const override { return -fvm::Sp(2 * this->transport_.damping(), this->k_); }
  tmp<fvScalarMatrix> epsilonSource() const override {
    return -fvm::Sp(1.2 * 2 * this->transport_.damping(), this->epsilon_);
  }
};

defineNamedTemplateTypeNameAndDebug(bedGasRAS, 0);
defineNamedTemplateTypeNameAndDebug(RASModels::kEpsilon<bedGasTurbulence>, 0);
defineNamedTemplateTypeNameAndDebug(RASModels::RNGkEpsilon<bedGasTurbulence>, 0);
defineNamedTemplateTypeNameAndDebug(RASModels::realizableKE<bedGasTurbulence>, 0);

}  // namespace Foam

namespace {

using Foam::volScalarField;

template <typename Type>
Foam::GeometricField<Type, Foam::fvPatchField, Foam::volMesh> field(const Foam::fvMesh& mesh, const char* name,
                                                                    const Foam::dimensionSet& dimensions,
                                                                    const Foam::wordList& patches) {
  return {Foam::IOobject(name, mesh.time().timeName(), mesh), mesh,
          Foam::dimensioned<Type>(name, dimensions, Foam::pTraits<Type>::one), patches};
}

class Turbulence final : public cupola::LocalTurbulence {
 public:
  Turbulence(Foam::fvMesh& mesh, const std::string& model, std::vector<Inlet> inlets)
      : mesh_(mesh),
        inlets_(std::move(inlets)),
        rho_(field<Foam::scalar>(mesh, "bedGasDensity", Foam::dimDensity, gradient_free(mesh))),
        mu_(field<Foam::scalar>(mesh, "bedGasViscosity", Foam::dimDynamicViscosity, gradient_free(mesh))),
        velocity_(field<Foam::vector>(mesh, "U", Foam::dimVelocity, velocity_patches(mesh))),
        flux_(Foam::IOobject("bedGasFlux", mesh.time().timeName(), mesh), mesh,
              Foam::dimensionedScalar("flux", Foam::dimMass / Foam::dimTime, 0)),
        damping_(field<Foam::scalar>(mesh, "bedGasDamping", Foam::dimDensity / Foam::dimTime, gradient_free(mesh))),
        gas_(mu_, rho_, damping_) {
    if (model == "RNGkEpsilon")
      model_ = make<Foam::RASModels::RNGkEpsilon<Foam::bedGasTurbulence>>();
    else if (model == "realizableKE")
      model_ = make<Foam::RASModels::realizableKE<Foam::bedGasTurbulence>>();
    else
      model_ = make<Foam::RASModels::kEpsilon<Foam::bedGasTurbulence>>();
  }

  void step(const Gas& gas, double seconds) override {
    auto& time = const_cast<Foam::Time&>(mesh_.time());
    time.setDeltaT(seconds);
    ++time;
    k().oldTime();
    epsilon().oldTime();
    take(gas);
    model_->correct();
  }

  void restore(const Gas& gas, const Fields& fields) override {
    take(gas);
    set_fields(fields);
  }

  Fields fields() const override { return {values(model_->k()()), values(model_->epsilon()())}; }

  void set_fields(const Fields& fields) override {
    for (Foam::label cell = 0; cell < mesh_.nCells(); ++cell) {
      k().primitiveFieldRef()[cell] = fields.k[static_cast<std::size_t>(cell)];
      epsilon().primitiveFieldRef()[cell] = fields.epsilon[static_cast<std::size_t>(cell)];
    }
    k().correctBoundaryConditions();
    epsilon().correctBoundaryConditions();
    model_->validate();
  }

  std::vector<double> eddy_viscosity() const override { return values(model_->nut()()); }

 private:
  template <typename Model>
  std::unique_ptr<Foam::bedGasRAS> make() {
    return std::make_unique<Foam::AmongGrains<Model>>(one_, rho_, velocity_, flux_, flux_, gas_,
                                                      Foam::turbulenceModel::propertiesName);
  }

  static Foam::wordList gradient_free(const Foam::fvMesh& mesh) {
    return Foam::wordList(mesh.boundary().size(), Foam::zeroGradientFvPatchScalarField::typeName);
  }

  Foam::wordList velocity_patches(const Foam::fvMesh& mesh) const {
    Foam::wordList types(mesh.boundary().size(), "zeroGradient");
    forAll(types, i) {
      if (mesh.boundary()[i].type() == "wall") types[i] = "slip";
      for (const Inlet& inlet : inlets_)
        if (mesh.boundary()[i].name() == inlet.name) types[i] = "fixedValue";
    }
    return types;
  }

  /// The models keep their fields to themselves; the mesh knows them by name.
  volScalarField& k() { return mesh_.lookupObjectRef<volScalarField>("k"); }
  volScalarField& epsilon() { return mesh_.lookupObjectRef<volScalarField>("epsilon"); }

  static std::vector<double> values(const volScalarField& field) {
    return {field.primitiveField().begin(), field.primitiveField().end()};
  }

  void set_flux(const std::vector<double>& flux) {
    for (Foam::label face = 0; face < mesh_.nInternalFaces(); ++face)
      flux_.primitiveFieldRef()[face] = flux[static_cast<std::size_t>(face)];
    auto& boundary = flux_.boundaryFieldRef();
    forAll(boundary, i) {
      const Foam::label start = mesh_.boundaryMesh()[i].start();
      forAll(boundary[i], face) boundary[i][face] =
          flux[static_cast<std::size_t>(start) + static_cast<std::size_t>(face)];
    }
  }

  void take(const Gas& gas) {
    rho_.oldTime();
    for (Foam::label cell = 0; cell < mesh_.nCells(); ++cell) {
      const auto c = static_cast<std::size_t>(cell);
      rho_.primitiveFieldRef()[cell] = gas.density[c];
      rho_.oldTime().primitiveFieldRef()[cell] = gas.density_before[c];
      mu_.primitiveFieldRef()[cell] = gas.viscosity[c];
      damping_.primitiveFieldRef()[cell] = gas.damping[c];
      velocity_.primitiveFieldRef()[cell] =
          Foam::vector(gas.velocity[3 * c], gas.velocity[3 * c + 1], gas.velocity[3 * c + 2]);
    }
    rho_.correctBoundaryConditions();
    mu_.correctBoundaryConditions();
    set_flux(gas.mass_flux);
    set_inlets();
    velocity_.correctBoundaryConditions();
  }

  /// k = 3/2 (intensity x speed)^2, epsilon = C_mu^(3/4) k^(3/2)/mixing length.
  void set_inlets() {
    constexpr double c_mu = 0.09;
    forAll(mesh_.boundary(), i) {
      for (const Inlet& inlet : inlets_) {
        const auto& patch = mesh_.boundary()[i];
        if (patch.name() != inlet.name) continue;
        velocity_.boundaryFieldRef()[i] ==
            patch.nf() * flux_.boundaryField()[i] / (patch.magSf() * rho_.boundaryField()[i]);
        const Foam::scalarField energy(1.5 * Foam::sqr(inlet.intensity) * Foam::magSqr(velocity_.boundaryField()[i]) +
                                       Foam::SMALL);
        k().boundaryFieldRef()[i] == energy;
        epsilon().boundaryFieldRef()[i] == std::pow(c_mu, 0.75) * Foam::pow(energy, 1.5) / inlet.mixing_length;
      }
    }
  }

  Foam::fvMesh& mesh_;
  std::vector<Inlet> inlets_;
  volScalarField rho_, mu_;
  Foam::volVectorField velocity_;
  Foam::surfaceScalarField flux_;
  volScalarField damping_;
  Foam::bedGas gas_;
  Foam::geometricOneField one_;
  std::unique_ptr<Foam::bedGasRAS> model_;
};

}  // namespace

extern "C" __attribute__((visibility("default"))) cupola::LocalTurbulence* cupola_make_turbulence(
    Foam::fvMesh& mesh, const std::string& model, const std::vector<cupola::LocalTurbulence::Inlet>& inlets) {
  return new Turbulence(mesh, model, inlets);
}
