#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "physics/closures/gas_properties.hpp"
#include "physics/equations/cell_equation.hpp"
#include "physics/equations/cell_failure.hpp"
#include "physics/equations/face_geometry.hpp"
#include "physics/gas/bed_gas.hpp"
#include "physics/gas/drag_tangent.hpp"
#include "physics/gas/inertia.hpp"
#include "schemas/failure.hpp"

namespace cupola {
namespace {

/// Mass is conserved to this share of the blast, summed over all cells.
constexpr double mass_tolerance = 3e-11;
/// Iterations before the last one conserve it to this share of the last change: what is not yet right need not be
/// exact.
constexpr double loose_mass_tolerance = 1e-2;
constexpr double acceptable_mass_residual = 1e-7;

double magnitude(const Vector3& v) { return std::sqrt(dot(v, v)); }

}  // namespace

struct DarcyForchheimer::State {
  State(FoamCase& foam, const BedMesh& bed_mesh, const Campaign& campaign)
      : mesh(bed_mesh),
        geometry(bed_mesh),
        equation(foam, bed_mesh),
        gas(*campaign.scene.gas),
        resistance(bed_mesh, gas, campaign.drag) {
    boundary_flux.assign(mesh.faces(), 0);
    for (const auto& inlet : gas.inlets) {
      const auto* patch = mesh.find_patch(inlet.name);
      if (patch == nullptr || patch->kind != BedMesh::PatchKind::inlet) {
        throw Failure(ExitCode::wrong_input, fmt::format("the mesh does not hold the inlet '{}'", inlet.name))
            .at("key", "scene.gas.inlets");
      }
      if (inlet.given != Inlet::Given::mass_flow) {
        throw Failure(ExitCode::wrong_input, fmt::format("the inlet '{}' must state its mass_flow", inlet.name))
            .at("key", "scene.gas.inlets");
      }
      const double opening = patch_area(*patch);
      for (auto face = patch->first_face; face < patch->first_face + patch->faces; ++face) {
        boundary_flux[face] = -inlet.mass_flow * geometry.area[face] / opening;
      }
      blast += inlet.mass_flow;
    }
    is_outlet.assign(mesh.faces(), false);
    double outlet_area = 0;
    for (const auto& patch : mesh.patches) {
      if (patch.kind != BedMesh::PatchKind::outlet) continue;
      outlet_area += patch_area(patch);
      std::fill_n(is_outlet.begin() + patch.first_face, patch.faces, true);
    }
    if (outlet_area <= 0) throw Failure(ExitCode::wrong_input, "the mesh has no outlet for the gas");
    if (blast <= 0) throw Failure(ExitCode::wrong_input, "no inlet blows any gas").at("key", "scene.gas.inlets");
    usual_flux = blast / outlet_area;
    psi_outlet = gas.outlet_pressure * gas.outlet_pressure / 2;
    start.squared_pressure.assign(mesh.cells(), 0);
  }

  [[nodiscard]] double patch_area(const BedMesh::Patch& patch) const {
    double sum = 0;
    for (auto face = patch.first_face; face < patch.first_face + patch.faces; ++face) sum += geometry.area[face];
    return sum;
  }

  /// Tangents of the drag law at the cells' mass fluxes; at the usual flux everywhere when there is none yet.
  void set_resistances(const BedState& bed, const std::vector<double>& gas_temperature) {
    std::vector<double> speed(mesh.cells(), usual_flux);
    for (std::size_t cell = 0; !cold && cell < mesh.cells(); ++cell) speed[cell] = magnitude(mass_flux[cell]);
    resistance.update(bed, gas_temperature, speed, usual_flux);
  }

  /// Resistance on the cell's side of a face: the normal flux is the face's, the tangential one the cell's (it jumps
  /// from layer to layer, the normal one does not).
  [[nodiscard]] DragTangents::Value at_face(std::int64_t cell, std::size_t face, double normal_flux) const {
    if (cold) return resistance.at(cell, usual_flux, 0);
    const Vector3& g = mass_flux[cell];
    const double along = dot(g, geometry.normal[face]);
    const double speed = std::sqrt(std::max(0.0, dot(g, g) - along * along) + normal_flux * normal_flux);
    return resistance.at(cell, speed, normal_flux);
  }

  [[nodiscard]] bool through_flow(std::size_t face) const { return mesh.face_neighbour[face] >= 0 || is_outlet[face]; }

  /// psi at the face as seen from one of its cells, from the cell's own law.
  [[nodiscard]] double psi_from(std::int64_t cell, const Vector3& offset, double normal_drop) const {
    const Vector3& g = mass_flux[cell];
    return start.squared_pressure[cell] - resistance.at_cell(cell) * dot(g, offset) - normal_drop;
  }

  /// One Newton step: the linearised law of every face,
  ///   g_new = g (1 - R/D) + (psi_P - psi_N - oblique)/D,   R g the drop of psi at g, D its derivative,
  /// put into the mass balance.
  /// @param tolerance of the mass balance, over the blast @return relative change
  double step(DarcyForchheimer::Result& result, double tolerance) {
    const std::size_t faces = mesh.faces();
    std::vector<double> conductance(faces, 0), fixed(faces, 0);
    for (std::size_t face = 0; face < faces; ++face) {
      if (!through_flow(face)) {
        fixed[face] = boundary_flux[face];
        continue;
      }
      const double area = geometry.area[face];
      const double flux = cold ? 0 : start.face_mass_flux[face];
      const auto owner = mesh.face_owner[face];
      const auto neighbour = mesh.face_neighbour[face];
      const auto [owner_value, owner_increase] = at_face(owner, face, flux / area);
      double drop = geometry.owner_distance[face] * owner_value;
      double slope = drop + geometry.owner_distance[face] * owner_increase;
      // Where the line of centres is not normal to the face: what psi changes along the face, from the cells' own law.
      double oblique = cold ? 0 : -owner_value * dot(mass_flux[owner], geometry.owner_offset[face]);
      if (neighbour >= 0) {
        const auto [value, increase] = at_face(neighbour, face, flux / area);
        drop += geometry.neighbour_distance[face] * value;
        slope += geometry.neighbour_distance[face] * (value + increase);
        if (!cold) oblique += value * dot(mass_flux[neighbour], geometry.neighbour_offset[face]);
      }
      conductance[face] = area / slope;
      fixed[face] = flux * (1 - drop / slope) + oblique * conductance[face];
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

  void finish() {
    pressure.resize(mesh.cells());
    for (std::size_t cell = 0; cell < mesh.cells(); ++cell) {
      pressure[cell] = std::sqrt(2 * (start.squared_pressure[cell] + psi_outlet));
    }
    set_gradient();
    set_inertia();
  }

  /// Face pressures from both sides' laws, their mean; then the surface integral over each cell.
  void set_gradient() {
    face_pressure.resize(mesh.faces());
    for (std::size_t face = 0; face < mesh.faces(); ++face) {
      const double flux = start.face_mass_flux[face];
      const double normal_flux = flux / geometry.area[face];
      const auto owner = mesh.face_owner[face];
      const auto neighbour = mesh.face_neighbour[face];
      const double owner_drop = geometry.owner_distance[face] * at_face(owner, face, normal_flux).value * normal_flux;
      double psi = psi_from(owner, geometry.owner_offset[face], owner_drop);
      if (is_outlet[face]) {
        psi = 0;
      } else if (neighbour >= 0) {
        const double drop =
            geometry.neighbour_distance[face] * at_face(neighbour, face, normal_flux).value * normal_flux;
        psi = (psi + psi_from(neighbour, geometry.neighbour_offset[face], -drop)) / 2;
      }
      face_pressure[face] = std::sqrt(2 * std::max(0.0, psi + psi_outlet));
    }
    gradient = FaceGeometry::surface_gradient(mesh, face_pressure);
  }

  void set_inertia() {
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

  const BedMesh& mesh;
  FaceGeometry geometry;
  CellEquation equation;
  Gas gas;
  DragTangents resistance;

  std::vector<double> boundary_flux;  ///< kg/s out of the owner, inlets; 0 elsewhere
  std::vector<bool> is_outlet;
  double blast = 0;       ///< kg/s
  double usual_flux = 0;  ///< kg/m2/s, blast over the outlet's area
  double psi_outlet = 0;  ///< Pa2

  bool cold = true;  ///< no mass fluxes known yet
  WarmStart start;
  std::vector<Vector3> mass_flux;
  std::vector<double> void_fraction, temperature;

  std::vector<double> pressure, face_pressure, inertia;
  std::vector<Vector3> gradient;
  double inertia_largest = 0;
};

DarcyForchheimer::DarcyForchheimer(FoamCase& foam, const BedMesh& mesh, const Campaign& campaign)
    : state_(std::make_unique<State>(foam, mesh, campaign)) {}
DarcyForchheimer::~DarcyForchheimer() = default;

DarcyForchheimer::Result DarcyForchheimer::solve(const BedState& bed, const std::vector<double>& gas_temperature,
                                                 double tolerance, int most_iterations) {
  State& state = *state_;
  state.void_fraction = bed.void_fraction;
  state.temperature = gas_temperature;
  Result result;
  // What the first iteration is expected to change: all from nothing, little from a warm start.
  result.change = state.cold ? 1 : 1e-3;
  for (bool last = false; !last;) {
    // The last iteration is the one that may be it: it conserves mass strictly.
    const bool strict = result.iterations + 1 >= most_iterations || result.change < 3 * tolerance;
    state.set_resistances(bed, gas_temperature);
    result.change =
        state.step(result, strict ? mass_tolerance : std::max(mass_tolerance, loose_mass_tolerance * result.change));
    ++result.iterations;
    last = strict && (result.change <= tolerance || result.iterations >= most_iterations);
  }
  state.set_resistances(bed, gas_temperature);
  state.finish();
  double residual = 0;
  for (const double value : FaceGeometry::outflow(state.mesh, state.start.face_mass_flux)) residual += std::abs(value);
  result.mass_residual = residual / state.blast;
  return result;
}

const std::vector<double>& DarcyForchheimer::pressure() const { return state_->pressure; }
const std::vector<Vector3>& DarcyForchheimer::mass_flux() const { return state_->mass_flux; }
const std::vector<Vector3>& DarcyForchheimer::pressure_gradient() const { return state_->gradient; }
const std::vector<double>& DarcyForchheimer::face_mass_flux() const { return state_->start.face_mass_flux; }
double DarcyForchheimer::inertia_over_drag_largest() const { return state_->inertia_largest; }
const std::vector<double>& DarcyForchheimer::inertia_over_drag() const { return state_->inertia; }
const DarcyForchheimer::WarmStart& DarcyForchheimer::warm_start() const { return state_->start; }

void DarcyForchheimer::restore(WarmStart start) {
  State& state = *state_;
  state.start = std::move(start);
  state.mass_flux = state.geometry.cell_vectors(state.mesh, state.start.face_mass_flux);
  state.cold = false;
}

std::vector<DarcyForchheimer::NamedInlet> DarcyForchheimer::inlets() const {
  const State& state = *state_;
  std::vector<NamedInlet> result;
  for (const auto& inlet : state.gas.inlets) {
    const auto& patch = *state.mesh.find_patch(inlet.name);
    const double opening = state.patch_area(patch);
    double pressure = 0;
    for (auto face = patch.first_face; face < patch.first_face + patch.faces; ++face) {
      pressure += state.face_pressure[face] * state.geometry.area[face] / opening;
    }
    result.push_back({inlet.name,
                      inlet_state(inlet.mass_flow, inlet.total_temperature, opening, pressure, state.gas.molar_mass,
                                  state.gas.heat_capacity),
                      smallest_opening(inlet.mass_flow, inlet.total_temperature, pressure, state.gas.molar_mass,
                                       state.gas.heat_capacity)});
  }
  return result;
}

}  // namespace cupola
