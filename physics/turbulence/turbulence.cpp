#include "physics/turbulence/turbulence.hpp"

#include <dlfcn.h>
#include <fmt/format.h>

#include <cmath>

#include "physics/closures/gas_properties.hpp"
#include "physics/closures/sutherland.hpp"
#include "physics/equations/cell_failure.hpp"
#include "physics/mesh/foam_errors.hpp"
#include "physics/mesh/foam_turbulence.hpp"

namespace cupola {
namespace {

/// OpenFOAM's turbulence libraries come with the module and are loaded by who uses them only.  It stays: OpenFOAM's
/// tables know its models.
MakeTurbulence load_module() {
  const auto file = std::filesystem::read_symlink("/proc/self/exe").parent_path() / "libcupola-turbulence.so";
  void* module = dlopen(file.c_str(), RTLD_NOW | RTLD_LOCAL);
  void* make = module != nullptr ? dlsym(module, "cupola_make_turbulence") : nullptr;
  if (make == nullptr) {
    const char* why = dlerror();
    throw Failure(ExitCode::input_output, fmt::format("{}: {}: build it (it belongs beside the program), or ask for "
                                                      "dem.transient.turbulence: laminar",
                                                      file.string(), why != nullptr ? why : "cannot be loaded"))
        .at("file", file.string());
  }
  return reinterpret_cast<MakeTurbulence>(make);
}

}  // namespace

Turbulence::Turbulence(FoamCase& foam, const BedMesh& mesh, const Campaign& campaign)
    : foam_(foam), mesh_(mesh), gas_(*campaign.scene.gas) {
  const MakeTurbulence make = load_module();
  std::vector<LocalTurbulence::Inlet> inlets;
  for (const Inlet& inlet : gas_.inlets)
    inlets.push_back({inlet.name, inlet_intensity, inlet_mixing_length(campaign, inlet)});
  with_foam_errors(ExitCode::input_output, "OpenFOAM cannot make the turbulence model", [&] {
    model_.reset(make(foam.mesh(), foam_turbulence_model(campaign.dem.transient.turbulence), inlets));
  });
  const InitialTurbulence first = initial_turbulence(campaign);
  set_fields(std::vector<double>(mesh.cells(), first.k), std::vector<double>(mesh.cells(), first.epsilon));
  eddy_viscosity_.assign(mesh.cells(), 0);  // until the flow has made a step
}

Turbulence::~Turbulence() = default;

void Turbulence::set_fields(const std::vector<double>& k, const std::vector<double>& epsilon) {
  k_ = k;
  epsilon_ = epsilon;
  model_->set_fields({foam_.local(k), foam_.local(epsilon)});
}

LocalTurbulence::Gas Turbulence::local_gas(const TransientFlow& flow, const std::vector<double>& before,
                                           const std::vector<double>& temperature) const {
  std::vector<double> viscosity(mesh_.cells()), damping(mesh_.cells());
  for (std::size_t cell = 0; cell < viscosity.size(); ++cell) {
    const double e = flow.void_fraction()[cell];
    viscosity[cell] = e * gas_viscosity(gas_, temperature[cell]);
    damping[cell] = e * e * flow.resistance()[cell];
  }
  LocalTurbulence::Gas gas{foam_.local(before),
                           foam_.local(flow.gas_by_volume()),
                           foam_.local(viscosity),
                           foam_.local(damping),
                           {},
                           foam_.local_fluxes(flow.face_mass_flux())};
  for (const std::int64_t cell : foam_.global_cell())
    for (const double component : flow.velocity()[static_cast<std::size_t>(cell)]) gas.velocity.push_back(component);
  return gas;
}

void Turbulence::restore(const TransientFlow& flow, const std::vector<double>& temperature,
                         const std::vector<double>& k, const std::vector<double>& epsilon,
                         std::vector<double> eddy_viscosity) {
  k_ = k;
  epsilon_ = epsilon;
  eddy_viscosity_ = std::move(eddy_viscosity);
  model_->restore(local_gas(flow, flow.gas_by_volume(), temperature), {foam_.local(k), foam_.local(epsilon)});
}

void Turbulence::step(const TransientFlow& flow, const std::vector<double>& temperature, double seconds) {
  const auto gas = local_gas(flow, flow.gas_by_volume_before(), temperature);
  with_foam_errors(ExitCode::diverged, "the turbulence model broke down", [&] { model_->step(gas, seconds); });
  const auto fields = model_->fields();
  k_ = foam_.everywhere(fields.k);
  epsilon_ = foam_.everywhere(fields.epsilon);
  eddy_viscosity_ = foam_.everywhere(model_->eddy_viscosity());
  const auto gas_by_volume = flow.gas_by_volume();
  for (std::size_t cell = 0; cell < mesh_.cells(); ++cell) {
    if (!std::isfinite(k_[cell]) || !std::isfinite(eddy_viscosity_[cell]))
      throw cell_failure(mesh_, "the turbulence of the gas is no longer finite", cell);
    eddy_viscosity_[cell] *= gas_by_volume[cell] / flow.void_fraction()[cell];
  }
}

std::unique_ptr<Turbulence> make_turbulence(FoamCase& foam, const BedMesh& mesh, const Campaign& campaign) {
  if (campaign.dem.transient.turbulence == TransientGas::Turbulence::laminar) return nullptr;
  return std::make_unique<Turbulence>(foam, mesh, campaign);
}

}  // namespace cupola
