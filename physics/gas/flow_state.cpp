#include "physics/gas/flow_state.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "physics/closures/gas_properties.hpp"
#include "physics/closures/gas_state.hpp"
#include "physics/equations/cell_failure.hpp"
#include "physics/gas/cell_vectors.hpp"
#include "physics/gas/inertia.hpp"
#include "schemas/failure.hpp"

namespace cupola {
namespace {

constexpr double acceptable_mass_residual = 1e-7;
/// Where the gas is faster than its heat allows, its static temperature is held at this share of the total one.
constexpr double least_static_share = 0.5;

}  // namespace

BedFlow::State::State(FoamCase& foam, const BedMesh& bed_mesh, const Campaign& campaign, Model which)
    : mesh(bed_mesh),
      geometry(bed_mesh),
      equation(foam, bed_mesh),
      gas(*campaign.scene.gas),
      model(which),
      openings(bed_mesh, geometry, gas),
      closing(bed_mesh, [this](std::size_t face) { return openings.holds_pressure(face); }),
      resistance(bed_mesh, gas, campaign.drag),
      blast(openings.expected_blast()),
      usual_flux(blast / openings.outlet_area()),
      psi_outlet(gas.outlet_pressure * gas.outlet_pressure / 2) {
  start.squared_pressure.assign(mesh.cells(), 0);
}

void BedFlow::State::set_resistances(const BedState& bed) {
  std::vector<double> speed(mesh.cells(), usual_flux);
  for (std::size_t cell = 0; !cold && cell < mesh.cells(); ++cell) speed[cell] = magnitude(mass_flux[cell]);
  resistance.update(bed, temperature, speed, usual_flux);
}

void BedFlow::State::set_static_temperature(const std::vector<double>& total) {
  temperature = total;
  too_fast = 0;
  if (!inertia_on || carried_velocity.empty()) return;
  const GasState properties(gas);
  for (std::size_t cell = 0; cell < mesh.cells(); ++cell) {
    const Vector3& u = carried_velocity[cell];
    const double cooled = dot(u, u) / (2 * properties.heat_capacity(total[cell]));
    if (cooled > (1 - least_static_share) * total[cell]) ++too_fast;
    temperature[cell] = std::max(total[cell] - cooled, least_static_share * total[cell]);
  }
}

void BedFlow::State::set_momentum() {
  std::vector<double> now(mesh.cells());
  carried_velocity.resize(mesh.cells(), Vector3{0, 0, 0});
  const double specific_gas_constant = molar_gas_constant / gas.molar_mass;
  for (std::size_t cell = 0; cell < mesh.cells(); ++cell) {
    now[cell] = std::sqrt(2 * (start.squared_pressure[cell] + psi_outlet));
    const double per_flux = specific_gas_constant * temperature[cell] / (now[cell] * void_fraction[cell]);
    for (std::size_t axis = 0; axis < 3; ++axis) {
      carried_velocity[cell][axis] += relaxation * (per_flux * mass_flux[cell][axis] - carried_velocity[cell][axis]);
    }
  }
  const auto pressure_there = inlet_pressure();
  const auto inlet_flow = openings.mass_flow(start.face_mass_flux);
  std::vector<Vector3> jets(pressure_there.size());
  for (std::size_t i = 0; i < jets.size(); ++i) {
    const double speed = openings.state(i, std::max(0.0, inlet_flow[i]), pressure_there[i]).velocity;
    const auto face = static_cast<std::size_t>(mesh.find_patch(openings.inlets()[i].name)->first_face);
    for (std::size_t axis = 0; axis < 3; ++axis) jets[i][axis] = -speed * geometry.normal[face][axis];
  }
  momentum = momentum_terms(mesh, geometry, openings, gas,
                            {start.face_mass_flux, carried_velocity, now, temperature, void_fraction, jets});
}

BedFlow::State::FaceLaw BedFlow::State::at_face(std::int64_t cell, std::size_t face, double normal_flux) const {
  if (cold) return {resistance.at(cell, usual_flux, 0), 0};
  const Vector3& g = mass_flux[cell];
  const double along = dot(g, geometry.normal[face]);
  const double speed = std::sqrt(std::max(0.0, dot(g, g) - along * along) + normal_flux * normal_flux);
  FaceLaw law{resistance.at(cell, speed, normal_flux), 0};
  if (inertia_on) {
    law.drag.value += momentum.resistance[cell];
    law.push = dot(momentum.push[cell], geometry.normal[face]);
  }
  return law;
}

double BedFlow::State::fall_along(std::int64_t cell, double law_value, const Vector3& offset) const {
  const double fall = law_value * dot(mass_flux[cell], offset);
  return inertia_on ? fall - dot(momentum.push[cell], offset) : fall;
}

double BedFlow::State::psi_from(std::int64_t cell, const Vector3& offset, double normal_fall) const {
  const double own = resistance.at_cell(cell) + (inertia_on ? momentum.resistance[cell] : 0);
  return start.squared_pressure[cell] - fall_along(cell, own, offset) - normal_fall;
}

double BedFlow::State::psi_at_face(std::size_t face) const {
  if (openings.holds_pressure(face)) return openings.psi(face);
  const double normal_flux = start.face_mass_flux[face] / geometry.area[face];
  const auto side = [&](std::int64_t cell) {
    const FaceLaw law = at_face(cell, face, normal_flux);
    return law.drag.value * normal_flux - law.push;
  };
  const auto owner = mesh.face_owner[face];
  const auto neighbour = mesh.face_neighbour[face];
  const double seen = psi_from(owner, geometry.owner_offset[face], geometry.owner_distance[face] * side(owner));
  if (neighbour < 0) return seen;
  return (seen +
          psi_from(neighbour, geometry.neighbour_offset[face], -geometry.neighbour_distance[face] * side(neighbour))) /
         2;
}

std::vector<double> BedFlow::State::inlet_pressure() const {
  std::vector<double> at_faces(mesh.faces(), 0);
  for (std::size_t face = 0; face < mesh.faces(); ++face) {
    if (openings.is_inlet(face)) at_faces[face] = std::sqrt(2 * std::max(0.0, psi_at_face(face) + psi_outlet));
  }
  return openings.mean(at_faces);
}

void BedFlow::State::follow_openings() {
  if (!cold && openings.state_velocity()) openings.follow_pressure(inlet_pressure());
}

void BedFlow::State::count_blast() {
  if (cold) return;
  blast = 0;
  for (const double flow : openings.mass_flow(start.face_mass_flux)) blast += flow;
  usual_flux = blast / openings.outlet_area();
}

double BedFlow::State::step(BedFlow::Result& result, double tolerance) {
  // The linearised law of a face, R g the fall of psi at g, D its derivative:
  //   g_new = g (1 - R/D) + (psi_P - psi_N - oblique + push)/D.
  const std::size_t faces = mesh.faces();
  std::vector<double> conductance(faces, 0), fixed(faces, 0);
  for (std::size_t face = 0; face < faces; ++face) {
    if (!through_flow(face)) {
      fixed[face] = openings.flux(face);
      continue;
    }
    const double area = geometry.area[face];
    const double flux = cold ? 0 : start.face_mass_flux[face];
    const auto owner = mesh.face_owner[face];
    const auto neighbour = mesh.face_neighbour[face];
    const FaceLaw near = at_face(owner, face, flux / area);
    double fall = geometry.owner_distance[face] * near.drag.value;
    double slope = fall + geometry.owner_distance[face] * near.drag.increase;
    double push = geometry.owner_distance[face] * near.push;
    // Where the line of centres is not normal to the face: what psi changes along the face, from the cells' own law.
    if (!cold) push -= fall_along(owner, near.drag.value, geometry.owner_offset[face]);
    if (neighbour >= 0) {
      const FaceLaw far = at_face(neighbour, face, flux / area);
      fall += geometry.neighbour_distance[face] * far.drag.value;
      slope += geometry.neighbour_distance[face] * (far.drag.value + far.drag.increase);
      push += geometry.neighbour_distance[face] * far.push;
      if (!cold) push += fall_along(neighbour, far.drag.value, geometry.neighbour_offset[face]);
    } else {
      push -= openings.psi(face);
    }
    conductance[face] = area / slope;
    fixed[face] = flux * (1 - fall / slope) + push * conductance[face];
  }

  CellCoefficients coefficients{std::vector<double>(mesh.cells(), 0), std::vector<double>(faces, 0),
                                std::vector<double>(mesh.internal_faces(), 0), true};
  for (std::size_t face = 0; face < faces; ++face) {
    coefficients.diagonal[mesh.face_owner[face]] += conductance[face];
    if (mesh.face_neighbour[face] >= 0) coefficients.owner_row[face] = conductance[face];
    if (face < mesh.internal_faces()) {
      coefficients.diagonal[mesh.face_neighbour[face]] += conductance[face];
      coefficients.neighbour_row[face] = conductance[face];
    }
  }
  auto source = FaceGeometry::outflow(mesh, fixed);
  for (double& value : source) value = -value;
  auto psi = start.squared_pressure;
  result.cycles += equation
                       .solve("gas pressure", coefficients, source, psi, tolerance * blast,
                              std::max(acceptable_mass_residual, 10 * tolerance) * blast)
                       .cycles;

  std::vector<double> flux(faces);
  double changed = 0, all = 0;
  for (std::size_t face = 0; face < faces; ++face) {
    flux[face] = fixed[face];
    if (through_flow(face)) {
      const double beyond = mesh.face_neighbour[face] >= 0 ? psi[mesh.face_neighbour[face]] : 0;
      flux[face] += conductance[face] * (psi[mesh.face_owner[face]] - beyond);
    }
    const double before = cold ? 0 : start.face_mass_flux[face];
    changed += (flux[face] - before) * (flux[face] - before);
    all += flux[face] * flux[face];
  }
  double changed_psi = 0, all_psi = 0;
  for (std::size_t cell = 0; cell < mesh.cells(); ++cell) {
    const double difference = psi[cell] - start.squared_pressure[cell];
    changed_psi += difference * difference * mesh.cell_volume[cell];
    all_psi += psi[cell] * psi[cell] * mesh.cell_volume[cell];
    if (!(psi[cell] + psi_outlet > 0)) throw cell_failure(mesh, "gas pressure is no longer positive", cell);
  }
  start.squared_pressure = std::move(psi);
  start.face_mass_flux = std::move(flux);
  mass_flux = geometry.cell_vectors(mesh, start.face_mass_flux);
  cold = false;
  return std::sqrt(std::max(changed / all, changed_psi / all_psi));
}

void BedFlow::State::set_pressure() {
  pressure.resize(mesh.cells());
  for (std::size_t cell = 0; cell < mesh.cells(); ++cell) {
    pressure[cell] = std::sqrt(2 * (start.squared_pressure[cell] + psi_outlet));
  }
}

void BedFlow::State::close_mass() {
  closing.close(start.face_mass_flux);
  mass_flux = geometry.cell_vectors(mesh, start.face_mass_flux);
}

void BedFlow::State::finish(const BedState& bed, const std::vector<double>& gas_temperature) {
  set_pressure();
  solved_for = {bed, gas_temperature};
  const auto flows = openings.mass_flow(start.face_mass_flux);
  for (std::size_t i = 0; i < flows.size(); ++i) {
    if (flows[i] > 0 || openings.inlets()[i].given != Inlet::Given::pressure) continue;
    throw Failure(ExitCode::wrong_input, fmt::format("gas flows out through the inlet '{}': its pressure of {} Pa is "
                                                     "below that of the bed; raise it",
                                                     openings.inlets()[i].name, openings.inlets()[i].pressure))
        .at("key", "scene.gas.inlets");
  }
}

void BedFlow::State::derive() {
  if (!solved_for) return;
  const Solved solved = *std::move(solved_for);
  solved_for.reset();
  set_static_temperature(solved.gas_temperature);
  set_resistances(solved.bed);
  set_gradient();
  set_inertia();
}

void BedFlow::State::set_gradient() {
  face_pressure.resize(mesh.faces());
  for (std::size_t face = 0; face < mesh.faces(); ++face)
    face_pressure[face] = std::sqrt(2 * std::max(0.0, psi_at_face(face) + psi_outlet));
  gradient = FaceGeometry::surface_gradient(mesh, face_pressure);
}

void BedFlow::State::set_inertia() {
  std::vector<double> density(mesh.cells()), drag(mesh.cells());
  for (std::size_t cell = 0; cell < mesh.cells(); ++cell) {
    density[cell] = gas_density(pressure[cell], temperature[cell], gas.molar_mass);
    // -grad p = -grad psi/p
    drag[cell] = resistance.at_cell(static_cast<std::int64_t>(cell)) * magnitude(mass_flux[cell]) / pressure[cell];
  }
  inertia = cupola::inertia_over_drag(mesh, {start.face_mass_flux, mass_flux, density, void_fraction, drag},
                                      0.01 * usual_flux);
  inertia_largest = *std::max_element(inertia.begin(), inertia.end());
}

}  // namespace cupola
