#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>

#include "physics/closures/enthalpy_zero.hpp"
#include "physics/closures/gas_state.hpp"
#include "physics/closures/syamlal_gidaspow.hpp"
#include "physics/equations/cell_equation.hpp"
#include "physics/equations/cell_failure.hpp"
#include "physics/equations/face_geometry.hpp"
#include "physics/gas/bed_gas.hpp"
#include "physics/gas/energy_sweeps.hpp"
#include "schemas/failure.hpp"

namespace cupola {
namespace {

/// The balance closes to this share of what comes in.
constexpr double balance_tolerance = 1e-11;
constexpr double acceptable_balance = 1e-8;
constexpr int most_corrections = 20;
/// Beyond this many transfer units the gas leaves a cell within a thousandth of what it exchanges with.
constexpr double most_transfer_units = 7;

/// What the gas of the cells exchanges heat with, solids and wall.
struct Partners {
  std::vector<double> conductance;              ///< W/K
  std::vector<double> conductance_temperature;  ///< W
  std::vector<double> stretch;                  ///< of the conductance as the leaving gas sees it
};

}  // namespace

struct GasEnergy::State {
  State(FoamCase& foam, const BedMesh& bed_mesh, const Campaign& campaign)
      : mesh(bed_mesh),
        geometry(bed_mesh),
        equation(foam, bed_mesh),
        properties(*campaign.scene.gas),
        thermodynamics(*campaign.scene.gas),
        heat_loss(campaign.scene.heat_loss) {
    inlet_temperature.assign(mesh.faces(), 0);
    double first_guess = 0;
    for (const auto& inlet : campaign.scene.gas->inlets) {
      const auto* patch = mesh.find_patch(inlet.name);
      if (patch == nullptr) {
        throw Failure(ExitCode::wrong_input, fmt::format("the mesh does not hold the inlet '{}'", inlet.name))
            .at("key", "scene.gas.inlets");
      }
      std::fill_n(inlet_temperature.begin() + patch->first_face, patch->faces, inlet.total_temperature);
      first_guess = std::max(first_guess, inlet.total_temperature);
    }
    temperature.assign(mesh.cells(), first_guess > 0 ? first_guess : enthalpy_zero);
    wall_share.assign(mesh.cells(), 0);
  }

  /// Share of the wall's area that loses the gas's heat, in each cell.
  void set_wall_share(const BedState& bed) {
    if (!heat_loss) return;
    for (std::size_t cell = 0; cell < mesh.cells(); ++cell) {
      wall_share[cell] = heat_loss->on == WallHeatLoss::On::gas      ? 1
                         : heat_loss->on == WallHeatLoss::On::solids ? 0
                                                                     : std::min(1.0, bed.void_fraction[cell]);
    }
  }

  /// The balance in terms of the temperature with which the gas leaves a cell.
  [[nodiscard]] EnergyBalance balance_of(const BedFlow& flow, const BedState& bed, Partners& partners) const;
  [[nodiscard]] Partners partners_of(const SolidsExchange& exchange) const;
  void put_in_order(const EnergyBalance& balance, const std::vector<double>& face_flux);
  void correct(const EnergyBalance& balance, double tolerance, double acceptable);
  [[nodiscard]] double wall_conductance(std::size_t face) const {
    return heat_loss->coefficient * geometry.area[face] * wall_share[mesh.face_owner[face]];
  }

  const BedMesh& mesh;
  FaceGeometry geometry;
  CellEquation equation;
  GasState properties;
  GasThermodynamics thermodynamics;
  std::optional<WallHeatLoss> heat_loss;
  std::vector<double> inlet_temperature;  ///< K, on the inlets' faces
  std::vector<double> temperature;        ///< K
  std::vector<std::int64_t> order;        ///< cells, each after those its gas comes from
  std::vector<double> ordered_flux;       ///< kg/s, face fluxes that the order belongs to
  std::vector<double> wall_share;
  Ledger ledger;
};

Partners GasEnergy::State::partners_of(const SolidsExchange& exchange) const {
  Partners partners{exchange.conductance, exchange.conductance_temperature, std::vector<double>(mesh.cells(), 1)};
  if (!heat_loss) return partners;
  for (const auto& patch : mesh.patches) {
    if (patch.kind != BedMesh::PatchKind::wall) continue;
    for (auto face = patch.first_face; face < patch.first_face + patch.faces; ++face) {
      const double loss = wall_conductance(static_cast<std::size_t>(face));
      partners.conductance[mesh.face_owner[face]] += loss;
      partners.conductance_temperature[mesh.face_owner[face]] += loss * heat_loss->ambient;
    }
  }
  return partners;
}

EnergyBalance GasEnergy::State::balance_of(const BedFlow& flow, const BedState& bed, Partners& partners) const {
  const std::vector<double>& face_flux = flow.face_mass_flux();
  std::vector<double> conductivity(mesh.cells());
  for (std::size_t cell = 0; cell < mesh.cells(); ++cell) {
    if (!(bed.void_fraction[cell] > 0)) {
      throw cell_failure(mesh, fmt::format("a cell without gas: void fraction {}", bed.void_fraction[cell]), cell);
    }
    conductivity[cell] = gas_conductivity_syamlal_gidaspow(std::min(1.0, bed.void_fraction[cell]),
                                                           properties.conductivity(temperature[cell]));
  }
  EnergyBalance balance{std::vector<std::array<EnergyBalance::Side, 6>>(mesh.cells()),
                        std::vector<double>(mesh.cells(), 0), std::vector<double>(mesh.cells(), 0),
                        std::vector<double>(mesh.cells(), 0), std::vector<double>(mesh.cells(), 0)};
  // What the gas brings into a cell counts against the cell's own temperature, so that no temperature can leave the
  // range of its neighbours', and gas flowing back through the outlet has the cell's own temperature.
  std::vector<int> filled(mesh.cells(), 0);
  for (std::size_t face = 0; face < mesh.faces(); ++face) {
    const auto owner = mesh.face_owner[face];
    const auto neighbour = mesh.face_neighbour[face];
    if (neighbour < 0) continue;
    const double conduction = geometry.area[face] / (geometry.owner_distance[face] / conductivity[owner] +
                                                     geometry.neighbour_distance[face] / conductivity[neighbour]);
    balance.sides[owner][filled[owner]++] = {neighbour, std::max(0.0, -face_flux[face]), conduction};
    if (face < mesh.internal_faces())
      balance.sides[neighbour][filled[neighbour]++] = {owner, std::max(0.0, face_flux[face]), conduction};
  }
  for (const auto& patch : mesh.patches) {
    for (auto face = patch.first_face; face < patch.first_face + patch.faces; ++face) {
      const auto owner = mesh.face_owner[face];
      if (patch.kind != BedMesh::PatchKind::inlet) continue;
      const double inflow = std::max(0.0, -face_flux[face]);
      balance.given_inflow[owner] += inflow;
      balance.given_enthalpy[owner] += inflow * thermodynamics.enthalpy(inlet_temperature[face]);
    }
  }
  // Gas that meets partners of one temperature leaves with T_out - T_p = (T_in - T_p) exp(-n), and what it gives is
  // C (exp(n) - 1)(T_out - T_p): the partners' conductance, seen from the outgoing gas, is stretched by (exp(n) - 1)/n.
  for (std::size_t cell = 0; cell < mesh.cells(); ++cell) {
    double inflow = balance.given_inflow[cell], carried = 0;
    for (const auto& side : balance.sides[cell]) {
      inflow += side.inflow;
      carried += side.conduction;
    }
    carried += inflow * thermodynamics.heat_capacity(temperature[cell]);
    const double conductance = partners.conductance[cell];
    if (!(carried + conductance > 0))
      throw cell_failure(mesh, "no gas, conduction or solids reach a cell: its temperature is open", cell);
    if (!(conductance > 0)) continue;
    if (carried > 0) {
      const double units = std::min(conductance / carried, most_transfer_units);
      partners.stretch[cell] = std::max(1.0, carried * std::expm1(units) / conductance);
    }
    balance.conductance[cell] = partners.stretch[cell] * conductance;
    balance.source[cell] = partners.stretch[cell] * partners.conductance_temperature[cell];
  }
  return balance;
}

/// Depth first against the flow, so that a cell comes after all that its gas comes from; where gas goes in circles,
/// after all but one.  Neighbours along the flow are neighbours in the order and mostly in memory.
void GasEnergy::State::put_in_order(const EnergyBalance& balance, const std::vector<double>& face_flux) {
  if (face_flux == ordered_flux) return;
  ordered_flux = face_flux;
  order.clear();
  std::vector<bool> reached(mesh.cells(), false);
  struct Open {
    std::int64_t cell;
    std::size_t next_side;
  };
  std::vector<Open> way;
  for (std::size_t cell = 0; cell < mesh.cells(); ++cell) {
    if (reached[cell]) continue;
    reached[cell] = true;
    way.push_back({static_cast<std::int64_t>(cell), 0});
    while (!way.empty()) {
      Open& here = way.back();
      const auto& sides = balance.sides[here.cell];
      if (here.next_side == sides.size()) {
        order.push_back(here.cell);
        way.pop_back();
        continue;
      }
      const auto& side = sides[here.next_side++];
      if (side.beside < 0 || side.inflow <= 0 || reached[side.beside]) continue;
      reached[side.beside] = true;
      way.push_back({side.beside, 0});
    }
  }
}

/// Where sweeps are slow (gas that goes in circles, conduction alone): Newton's method with OpenFOAM's solver.
void GasEnergy::State::correct(const EnergyBalance& balance, double tolerance, double acceptable) {
  for (int correction = 0; correction < most_corrections; ++correction) {
    const auto left = imbalance(balance, thermodynamics, temperature);
    double sum = 0;
    for (const double value : left) sum += std::abs(value);
    if (sum <= tolerance) return;
    CellCoefficients coefficients{balance.conductance, std::vector<double>(mesh.faces(), 0),
                                  std::vector<double>(mesh.internal_faces(), 0), false};
    for (std::size_t cell = 0; cell < mesh.cells(); ++cell) {
      double inflow = balance.given_inflow[cell];
      for (const auto& side : balance.sides[cell]) {
        inflow += side.inflow;
        coefficients.diagonal[cell] += side.conduction;
      }
      coefficients.diagonal[cell] += inflow * thermodynamics.heat_capacity(temperature[cell]);
    }
    std::vector<int> read(mesh.cells(), 0);
    for (std::size_t face = 0; face < mesh.faces(); ++face) {
      const auto owner = mesh.face_owner[face];
      const auto neighbour = mesh.face_neighbour[face];
      if (neighbour < 0) continue;
      const auto coefficient = [&](std::int64_t cell) {
        const auto& side = balance.sides[cell][read[cell]++];
        return side.conduction + side.inflow * thermodynamics.heat_capacity(temperature[side.beside]);
      };
      coefficients.owner_row[face] = coefficient(owner);
      if (face < mesh.internal_faces()) coefficients.neighbour_row[face] = coefficient(neighbour);
    }
    std::vector<double> change(mesh.cells(), 0);
    equation.solve("gas temperature", coefficients, left, change, 0.3 * tolerance, std::max(acceptable, 0.1 * sum));
    for (std::size_t cell = 0; cell < mesh.cells(); ++cell) temperature[cell] += change[cell];
    if (thermodynamics.constant()) return;
  }
}

GasEnergy::GasEnergy(FoamCase& foam, const BedMesh& mesh, const Campaign& campaign)
    : state_(std::make_unique<State>(foam, mesh, campaign)) {}
GasEnergy::~GasEnergy() = default;

const std::vector<double>& GasEnergy::solve(const BedFlow& flow, const BedState& bed, const SolidsExchange& exchange) {
  State& state = *state_;
  const BedMesh& mesh = state.mesh;
  const std::vector<double>& face_flux = flow.face_mass_flux();
  state.set_wall_share(bed);
  Partners partners = state.partners_of(exchange);
  const EnergyBalance balance = state.balance_of(flow, bed, partners);
  state.put_in_order(balance, face_flux);

  GasEnergy::Ledger ledger;
  for (const double value : balance.given_enthalpy) ledger.blast += value;
  double scale = std::abs(ledger.blast);
  for (std::size_t cell = 0; cell < mesh.cells(); ++cell) {
    scale += std::abs(exchange.conductance_temperature[cell] - exchange.conductance[cell] * enthalpy_zero);
  }
  auto& temperature = state.temperature;
  const double tolerance = balance_tolerance * scale;
  double remaining = 0;
  sweep(balance, state.thermodynamics, state.order, tolerance, temperature, remaining);
  if (!(remaining <= tolerance)) {
    state.correct(balance, tolerance, acceptable_balance * scale);
    remaining = 0;
    for (const double value : imbalance(balance, state.thermodynamics, temperature)) remaining += std::abs(value);
  }
  if (!(remaining <= acceptable_balance * scale)) {
    std::size_t cell = 0;
    while (cell + 1 < temperature.size() && std::isfinite(temperature[cell])) ++cell;
    throw cell_failure(
        mesh,
        fmt::format("gas temperature could not be solved (balance open by {:.2g}), last looked at", remaining / scale),
        cell);
  }

  // From here on `temperature` is the mean that the partners felt; the gas leaves with `leaving`.
  const std::vector<double> leaving = temperature;
  for (std::size_t cell = 0; cell < mesh.cells(); ++cell) {
    if (!(partners.conductance[cell] > 0)) continue;
    const double partner = partners.conductance_temperature[cell] / partners.conductance[cell];
    temperature[cell] = partner + partners.stretch[cell] * (leaving[cell] - partner);
  }
  double outflow = 0, above_reference = 0;
  for (const auto& patch : mesh.patches) {
    for (auto face = patch.first_face; face < patch.first_face + patch.faces; ++face) {
      const auto owner = mesh.face_owner[face];
      if (patch.kind == BedMesh::PatchKind::outlet) {
        ledger.top_gas += face_flux[face] * state.thermodynamics.enthalpy(leaving[owner]);
        above_reference += face_flux[face] * (leaving[owner] - enthalpy_zero);
        outflow += face_flux[face];
      } else if (patch.kind == BedMesh::PatchKind::wall && state.heat_loss) {
        ledger.walls +=
            state.wall_conductance(static_cast<std::size_t>(face)) * (temperature[owner] - state.heat_loss->ambient);
      }
    }
  }
  for (std::size_t cell = 0; cell < mesh.cells(); ++cell)
    ledger.to_solids += exchange.conductance[cell] * temperature[cell] - exchange.conductance_temperature[cell];
  ledger.top_gas_temperature = enthalpy_zero + (outflow != 0 ? above_reference / outflow : 0);
  ledger.residual = scale > 0 ? (ledger.blast - ledger.top_gas - ledger.walls - ledger.to_solids) / scale : 0;
  state.ledger = ledger;
  return temperature;
}

const std::vector<double>& GasEnergy::temperature() const { return state_->temperature; }
void GasEnergy::restore(const std::vector<double>& temperature) { state_->temperature = temperature; }
const GasEnergy::Ledger& GasEnergy::ledger() const { return state_->ledger; }

}  // namespace cupola
