#include "physics/gas/openings.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "physics/closures/gas_properties.hpp"
#include "physics/closures/gas_state.hpp"
#include "schemas/failure.hpp"

namespace cupola {
namespace {

/// A mass flux to begin with where only pressures are known, kg/m2/s.
constexpr double guessed_flux = 0.5;
/// Inlets that state a velocity are given up above this pressure, over the outlet's.
constexpr double hopeless_pressure = 100;

}  // namespace

Openings::Openings(const BedMesh& mesh, const FaceGeometry& geometry, const Gas& gas)
    : mesh_(mesh),
      geometry_(geometry),
      gas_(gas),
      kind_(mesh.faces(), Kind::closed),
      value_(mesh.faces(), 0),
      inlet_of_(mesh.faces(), -1) {
  for (const auto& patch : mesh.patches) {
    if (patch.kind != BedMesh::PatchKind::outlet) continue;
    for (auto face = patch.first_face; face < patch.first_face + patch.faces; ++face) {
      outlet_area_ += geometry.area[face];
      kind_[face] = Kind::pressure;
    }
  }
  if (outlet_area_ <= 0) throw Failure(ExitCode::wrong_input, "the mesh has no outlet for the gas");
  for (const auto& inlet : gas_.inlets) {
    const auto* patch = mesh.find_patch(inlet.name);
    if (patch == nullptr || patch->kind != BedMesh::PatchKind::inlet) {
      throw Failure(ExitCode::wrong_input, fmt::format("the mesh does not hold the inlet '{}'", inlet.name))
          .at("key", "scene.gas.inlets");
    }
    const auto index = patch_.size();
    patch_.push_back(patch);
    double area = 0;
    for (auto face = patch->first_face; face < patch->first_face + patch->faces; ++face) {
      area += geometry.area[face];
      inlet_of_[face] = static_cast<int>(index);
    }
    area_.push_back(area);
    opening_.push_back(inlet.side == Inlet::Side::bottom ? area : inlet.size[0] * inlet.size[1]);
    if (inlet.given == Inlet::Given::pressure) {
      for (auto face = patch->first_face; face < patch->first_face + patch->faces; ++face) {
        kind_[face] = Kind::pressure;
        value_[face] = (inlet.pressure * inlet.pressure - gas_.outlet_pressure * gas_.outlet_pressure) / 2;
      }
      expected_blast_ += guessed_flux * outlet_area_ / static_cast<double>(gas_.inlets.size());
      continue;
    }
    for (auto face = patch->first_face; face < patch->first_face + patch->faces; ++face) kind_[face] = Kind::flux;
    if (inlet.given == Inlet::Given::mass_flow) set_flux(index, inlet.mass_flow);
  }
  follow_pressure(std::vector<double>(gas_.inlets.size(), gas_.outlet_pressure));
  if (!(expected_blast_ > 0))
    throw Failure(ExitCode::wrong_input, "no inlet blows any gas").at("key", "scene.gas.inlets");
}

void Openings::set_flux(std::size_t inlet, double mass_flow) {
  const auto& patch = *patch_[inlet];
  for (auto face = patch.first_face; face < patch.first_face + patch.faces; ++face) {
    expected_blast_ += value_[face];
    value_[face] = -mass_flow * geometry_.area[face] / area_[inlet];
    expected_blast_ -= value_[face];
  }
}

void Openings::follow_pressure(const std::vector<double>& pressure) {
  const GasState properties(gas_);
  for (std::size_t i = 0; i < gas_.inlets.size(); ++i) {
    const Inlet& inlet = gas_.inlets[i];
    if (inlet.given != Inlet::Given::velocity) continue;
    const double cooled = inlet.velocity * inlet.velocity / (2 * properties.heat_capacity(inlet.total_temperature));
    if (!(inlet.total_temperature > cooled)) {
      throw Failure(ExitCode::wrong_input,
                    fmt::format("gas of {} K cannot leave the inlet '{}' at {} m/s: its whole heat is less",
                                inlet.total_temperature, inlet.name, inlet.velocity))
          .at("key", "scene.gas.inlets");
    }
    if (!(pressure[i] < hopeless_pressure * gas_.outlet_pressure)) {
      throw Failure(ExitCode::diverged,
                    fmt::format("the pressure in the inlet '{}' grows without limit at a velocity of {} m/s: the mass "
                                "flow grows with the pressure",
                                inlet.name, inlet.velocity))
          .at("key", "scene.gas.inlets")
          .advise("scene.gas.inlets", "mass_flow instead of velocity");
    }
    set_flux(
        i, gas_density(pressure[i], inlet.total_temperature - cooled, gas_.molar_mass) * inlet.velocity * opening_[i]);
  }
}

bool Openings::state_velocity() const {
  return std::any_of(gas_.inlets.begin(), gas_.inlets.end(),
                     [](const Inlet& inlet) { return inlet.given == Inlet::Given::velocity; });
}

std::vector<double> Openings::mass_flow(const std::vector<double>& face_mass_flux) const {
  std::vector<double> result(patch_.size(), 0);
  for (std::size_t i = 0; i < patch_.size(); ++i) {
    const auto& patch = *patch_[i];
    for (auto face = patch.first_face; face < patch.first_face + patch.faces; ++face) result[i] -= face_mass_flux[face];
  }
  return result;
}

std::vector<double> Openings::mean(const std::vector<double>& face_value) const {
  std::vector<double> result(patch_.size(), 0);
  for (std::size_t i = 0; i < patch_.size(); ++i) {
    const auto& patch = *patch_[i];
    for (auto face = patch.first_face; face < patch.first_face + patch.faces; ++face)
      result[i] += face_value[face] * geometry_.area[face] / area_[i];
  }
  return result;
}

InletState Openings::state(std::size_t inlet, double mass_flow, double pressure) const {
  const double total = gas_.inlets[inlet].total_temperature;
  return inlet_state(mass_flow, total, opening_[inlet], pressure, gas_.molar_mass, GasState(gas_).heat_capacity(total));
}

double Openings::smallest_opening(std::size_t inlet, double mass_flow, double pressure) const {
  const double total = gas_.inlets[inlet].total_temperature;
  return cupola::smallest_opening(mass_flow, total, pressure, gas_.molar_mass, GasState(gas_).heat_capacity(total));
}

}  // namespace cupola
