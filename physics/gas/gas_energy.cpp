#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>

#include "physics/closures/gas_properties.hpp"
#include "physics/closures/syamlal_gidaspow.hpp"
#include "physics/equations/cell_equation.hpp"
#include "physics/equations/cell_failure.hpp"
#include "physics/equations/face_geometry.hpp"
#include "physics/gas/bed_gas.hpp"
#include "schemas/failure.hpp"

namespace cupola {
namespace {

/// Enthalpies count from here, and the equation is solved for the temperature above it, K.
constexpr double reference_temperature = 293;
/// The balance closes to this share of what comes in.
constexpr double balance_tolerance = 1e-11;
constexpr double acceptable_balance = 1e-8;
/// Beyond this many transfer units the gas leaves a cell within a thousandth of what it exchanges with.
constexpr double most_transfer_units = 7;

}  // namespace

struct GasEnergy::State {
  State(FoamCase& foam, const BedMesh& bed_mesh, const Campaign& campaign)
      : mesh(bed_mesh),
        geometry(bed_mesh),
        equation(foam, bed_mesh),
        gas(*campaign.scene.gas),
        heat_loss(campaign.scene.heat_loss) {
    conductivity = gas_conductivity(gas.viscosity, gas.heat_capacity, gas.prandtl);
    inlet_temperature.assign(mesh.faces(), 0);
    double first_guess = 0;
    for (const auto& inlet : gas.inlets) {
      const auto* patch = mesh.find_patch(inlet.name);
      if (patch == nullptr) {
        throw Failure(ExitCode::wrong_input, fmt::format("the mesh does not hold the inlet '{}'", inlet.name))
            .at("key", "scene.gas.inlets");
      }
      std::fill_n(inlet_temperature.begin() + patch->first_face, patch->faces,
                  inlet.total_temperature - reference_temperature);
      first_guess = std::max(first_guess, inlet.total_temperature);
    }
    temperature.assign(mesh.cells(), gas.inlets.empty() ? reference_temperature : first_guess);
  }

  const BedMesh& mesh;
  FaceGeometry geometry;
  CellEquation equation;
  Gas gas;
  std::optional<WallHeatLoss> heat_loss;
  double conductivity = 0;                ///< of the gas, W/m/K
  std::vector<double> inlet_temperature;  ///< K above the reference, on the inlets' faces
  std::vector<double> temperature;        ///< K
  Ledger ledger;
};

GasEnergy::GasEnergy(FoamCase& foam, const BedMesh& mesh, const Campaign& campaign)
    : state_(std::make_unique<State>(foam, mesh, campaign)) {}
GasEnergy::~GasEnergy() = default;

const std::vector<double>& GasEnergy::solve(const DarcyForchheimer& flow, const BedState& bed,
                                            const SolidsExchange& exchange) {
  State& state = *state_;
  const BedMesh& mesh = state.mesh;
  const FaceGeometry& geometry = state.geometry;
  const std::vector<double>& face_flux = flow.face_mass_flux();

  std::vector<double> conductivity(mesh.cells());
  for (std::size_t cell = 0; cell < mesh.cells(); ++cell) {
    if (!(bed.void_fraction[cell] > 0)) {
      throw cell_failure(mesh, fmt::format("a cell without gas: void fraction {}", bed.void_fraction[cell]), cell);
    }
    conductivity[cell] = gas_conductivity_syamlal_gidaspow(std::min(1.0, bed.void_fraction[cell]), state.conductivity);
  }

  // The unknown is the temperature above the reference with which the gas leaves a cell.
  CellCoefficients coefficients{std::vector<double>(mesh.cells(), 0), std::vector<double>(mesh.faces(), 0),
                                std::vector<double>(mesh.internal_faces(), 0), false};
  std::vector<double> source(mesh.cells(), 0);
  // What the gas brings into a cell counts against the cell's own temperature, so that every off-diagonal coefficient
  // is an inflow, no temperature can leave the range of its neighbours', and gas flowing back through the outlet has
  // the cell's own temperature.
  for (std::size_t face = 0; face < mesh.faces(); ++face) {
    const auto owner = mesh.face_owner[face];
    const auto neighbour = mesh.face_neighbour[face];
    if (neighbour < 0) continue;
    const double carried = state.gas.heat_capacity * face_flux[face];
    const double conduction = geometry.area[face] / (geometry.owner_distance[face] / conductivity[owner] +
                                                     geometry.neighbour_distance[face] / conductivity[neighbour]);
    coefficients.owner_row[face] = conduction + std::max(0.0, -carried);
    coefficients.diagonal[owner] += coefficients.owner_row[face];
    if (face < mesh.internal_faces()) {
      coefficients.neighbour_row[face] = conduction + std::max(0.0, carried);
      coefficients.diagonal[neighbour] += coefficients.neighbour_row[face];
    }
  }
  // What the gas of a cell exchanges heat with, solids and wall: conductance, and conductance x temperature.
  std::vector<double> partners = exchange.conductance;
  std::vector<double> partners_temperature(mesh.cells());
  double exchanged = 0;
  for (std::size_t cell = 0; cell < mesh.cells(); ++cell) {
    partners_temperature[cell] =
        exchange.conductance_temperature[cell] - exchange.conductance[cell] * reference_temperature;
    exchanged += std::abs(partners_temperature[cell]);
  }
  GasEnergy::Ledger ledger;
  for (const auto& patch : mesh.patches) {
    for (auto face = patch.first_face; face < patch.first_face + patch.faces; ++face) {
      const auto owner = mesh.face_owner[face];
      if (patch.kind == BedMesh::PatchKind::inlet) {
        const double carried = -state.gas.heat_capacity * face_flux[face];
        coefficients.diagonal[owner] += carried;
        source[owner] += carried * state.inlet_temperature[face];
        ledger.blast += carried * state.inlet_temperature[face];
      } else if (patch.kind == BedMesh::PatchKind::wall && state.heat_loss) {
        const double loss = state.heat_loss->coefficient * geometry.area[face];
        partners[owner] += loss;
        partners_temperature[owner] += loss * (state.heat_loss->ambient - reference_temperature);
      }
    }
  }
  // Gas that meets partners of one temperature leaves with T_out - T_p = (T_in - T_p) exp(-n), and what it gives is
  // C (exp(n) - 1)(T_out - T_p): the partners' conductance, seen from the outgoing gas, is stretched by (exp(n) - 1)/n.
  std::vector<double> stretch(mesh.cells(), 1);
  for (std::size_t cell = 0; cell < mesh.cells(); ++cell) {
    if (!(partners[cell] > 0)) continue;
    const double carried = coefficients.diagonal[cell];
    if (carried > 0) {
      const double units = std::min(partners[cell] / carried, most_transfer_units);
      stretch[cell] = std::max(1.0, carried * std::expm1(units) / partners[cell]);
    }
    coefficients.diagonal[cell] += stretch[cell] * partners[cell];
    source[cell] += stretch[cell] * partners_temperature[cell];
  }
  for (std::size_t cell = 0; cell < mesh.cells(); ++cell) {
    if (!(coefficients.diagonal[cell] > 0))
      throw cell_failure(mesh, "no gas, conduction or solids reach a cell: its temperature is open", cell);
  }

  auto& temperature = state.temperature;
  for (double& value : temperature) value -= reference_temperature;
  const double scale = std::abs(ledger.blast) + exchanged;
  state.equation.solve("gas temperature", coefficients, source, temperature, balance_tolerance * scale,
                       acceptable_balance * scale);

  // From here on `temperature` is the mean that the partners felt; the gas leaves with `leaving`.
  const std::vector<double> leaving = temperature;
  for (std::size_t cell = 0; cell < mesh.cells(); ++cell) {
    if (!(partners[cell] > 0)) continue;
    const double partner = partners_temperature[cell] / partners[cell];
    temperature[cell] = partner + stretch[cell] * (leaving[cell] - partner);
  }
  double outflow = 0;
  for (const auto& patch : mesh.patches) {
    for (auto face = patch.first_face; face < patch.first_face + patch.faces; ++face) {
      const auto owner = mesh.face_owner[face];
      if (patch.kind == BedMesh::PatchKind::outlet) {
        ledger.top_gas += state.gas.heat_capacity * face_flux[face] * leaving[owner];
        outflow += state.gas.heat_capacity * face_flux[face];
      } else if (patch.kind == BedMesh::PatchKind::wall && state.heat_loss) {
        ledger.walls += state.heat_loss->coefficient * geometry.area[face] *
                        (temperature[owner] + reference_temperature - state.heat_loss->ambient);
      }
    }
  }
  for (std::size_t cell = 0; cell < mesh.cells(); ++cell) {
    temperature[cell] += reference_temperature;
    ledger.to_solids += exchange.conductance[cell] * temperature[cell] - exchange.conductance_temperature[cell];
  }
  ledger.top_gas_temperature = reference_temperature + (outflow != 0 ? ledger.top_gas / outflow : 0);
  ledger.residual = scale > 0 ? (ledger.blast - ledger.top_gas - ledger.walls - ledger.to_solids) / scale : 0;
  state.ledger = ledger;
  return temperature;
}

const std::vector<double>& GasEnergy::temperature() const { return state_->temperature; }
void GasEnergy::restore(const std::vector<double>& temperature) { state_->temperature = temperature; }
const GasEnergy::Ledger& GasEnergy::ledger() const { return state_->ledger; }

}  // namespace cupola
