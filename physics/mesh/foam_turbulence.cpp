#include "physics/mesh/foam_turbulence.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "physics/closures/gas_properties.hpp"
#include "physics/mesh/foam_dictionaries.hpp"
#include "physics/plan/charge.hpp"
#include "schemas/files.hpp"

namespace cupola {
namespace {

/// A uniform field; its values at inlets are set with the flow.
std::string uniform_field(const Campaign& campaign, const std::string& name, const std::string& dimensions,
                          double value) {
  std::string inlets;
  if (name != "nut")
    for (const Inlet& inlet : campaign.scene.gas->inlets)
      inlets += fmt::format("    {} {{ type fixedValue; value uniform {:.17g}; }}\n", inlet.name, value);
  std::string sides;
  if (campaign.scene.geometry.sides == Geometry::Sides::periodic)
    sides = "    front { type cyclic; }\n    back { type cyclic; }\n";
  return foam_file_head(name, "volScalarField") +
         fmt::format(
             "dimensions {};\ninternalField uniform {:.17g};\nboundaryField\n{{\n{}{}    \".*\" {{ type {}; value "
             "uniform 0; }}\n}}\n",
             dimensions, value, inlets, sides, name == "nut" ? "calculated" : "zeroGradient");
}

}  // namespace

bool has_turbulence(const Campaign& campaign) {
  return campaign.scene.gas && campaign.dem.gas == DemSettings::GasModel::transient &&
         campaign.dem.transient.turbulence != TransientGas::Turbulence::laminar;
}

std::string foam_turbulence_model(TransientGas::Turbulence model) {
  switch (model) {
    case TransientGas::Turbulence::rng_k_epsilon:
      return "RNGkEpsilon";
    case TransientGas::Turbulence::realizable_k_epsilon:
      return "realizableKE";
    case TransientGas::Turbulence::k_epsilon:
      return "kEpsilon";
    case TransientGas::Turbulence::laminar:
      break;
  }
  return "laminar";
}

double inlet_mixing_length(const Campaign& campaign, const Inlet& inlet) {
  std::array<double, 2> size = inlet.size;
  if (inlet.side == Inlet::Side::bottom)
    size = {campaign.scene.geometry.depth, 2 * campaign.half_width(campaign.bottom())};
  return 0.07 * 2 * size[0] * size[1] / (size[0] + size[1]);
}

InitialTurbulence initial_turbulence(const Campaign& campaign) {
  constexpr double c_mu = 0.09, least_speed = 1e-3;
  const Gas& gas = *campaign.scene.gas;
  double mass_flow = 0, length = 0;
  for (const Inlet& inlet : gas.inlets) {
    mass_flow += inlet.mass_flow;
    length = std::max(length, inlet_mixing_length(campaign, inlet));
  }
  const double density = gas_density(gas.outlet_pressure, gas.inlets.front().total_temperature, gas.molar_mass);
  const double speed = std::max(least_speed, mass_flow / density / slot_area(campaign, campaign.bottom()));
  const double k = 1.5 * std::pow(inlet_intensity * speed, 2);
  return {k, std::pow(c_mu, 0.75) * std::pow(k, 1.5) / length};
}

void write_foam_turbulence(const std::filesystem::path& case_folder, const Campaign& campaign) {
  const std::filesystem::path constant = case_folder / "constant", begin = case_folder / "0";
  std::filesystem::create_directories(constant);
  std::filesystem::create_directories(begin);
  write_text_atomically(constant / "turbulenceProperties",
                        foam_file_head("turbulenceProperties") +
                            fmt::format("simulationType RAS;\nRAS\n{{\n    RASModel {};\n    turbulence on;\n}}\n",
                                        foam_turbulence_model(campaign.dem.transient.turbulence)));
  const InitialTurbulence first = initial_turbulence(campaign);
  write_text_atomically(begin / "k", uniform_field(campaign, "k", "[0 2 -2 0 0 0 0]", first.k));
  write_text_atomically(begin / "epsilon", uniform_field(campaign, "epsilon", "[0 2 -3 0 0 0 0]", first.epsilon));
  write_text_atomically(begin / "nut", uniform_field(campaign, "nut", "[0 2 -1 0 0 0 0]", 0));
}

}  // namespace cupola
