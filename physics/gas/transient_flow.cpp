#include "physics/gas/transient_flow.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "physics/closures/drag.hpp"
#include "physics/closures/gas_properties.hpp"
#include "physics/closures/sutherland.hpp"
#include "physics/equations/cell_failure.hpp"
#include "physics/gas/cell_vectors.hpp"

namespace cupola {
namespace {

// Of a time step's pressure equation, over the flows through the bed.
constexpr double step_tolerance = 1e-10;
constexpr double acceptable_step_residual = 1e-6;

/// Shear is explicit: what it exchanges in a step is at most this share of a cell's gas.  Eddies that would exchange
/// more are as wide as the cells, where upwind convection diffuses as much by itself.
constexpr double largest_shear_exchange = 0.5;

}  // namespace

TransientFlow::TransientFlow(FoamCase& foam, const BedMesh& mesh, const Campaign& campaign,
                             const std::vector<double>& temperature)
    : mesh_(mesh),
      geometry_(mesh),
      equation_(foam, mesh),
      campaign_(campaign),
      openings_(mesh, geometry_, *campaign.scene.gas),
      blast_(openings_.expected_blast()),
      pressure_(mesh.cells(), campaign.scene.gas->outlet_pressure),
      face_pressure_(mesh.faces(), campaign.scene.gas->outlet_pressure),
      flux_(mesh.faces(), 0),
      void_fraction_(mesh.cells(), 1),
      density_(mesh.cells(), 0),
      resistance_(mesh.cells(), 0),
      oblique_(2 * mesh.faces(), 0),
      velocity_(mesh.cells(), Vector3{}),
      gradient_(mesh.cells(), Vector3{}),
      drag_(mesh.cells(), Vector3{}) {
  for (std::size_t cell = 0; cell < mesh.cells(); ++cell)
    density_[cell] = gas_density(pressure_[cell], temperature[cell], campaign.scene.gas->molar_mass);
  for (std::size_t face = 0; face < mesh.faces(); ++face)
    if (!through_flow(face)) flux_[face] = openings_.flux(face);
}

void TransientFlow::take_void_fraction(const std::vector<double>& void_fraction) { void_fraction_ = void_fraction; }

void TransientFlow::step(const Solids& solids, const std::vector<double>& temperature, double seconds) {
  const std::size_t cells = mesh_.cells();
  if (openings_.state_velocity()) openings_.follow_pressure(openings_.mean(face_pressure_));
  convection_ = convection(temperature, seconds);
  std::vector<double> gas_before(cells);
  for (std::size_t cell = 0; cell < cells; ++cell)
    gas_before[cell] = mesh_.cell_volume[cell] * void_fraction_[cell] * density_[cell];
  gas_by_volume_before_ = gas_by_volume();
  const auto flux_before = flux_;
  void_fraction_ = solids.bed.void_fraction;
  // Where the line of centres is not normal to the face: the change of pressure in the face's plane, from the step
  // before.
  for (std::size_t face = 0; face < mesh_.faces(); ++face) {
    oblique_[2 * face] = dot(gradient_[mesh_.face_owner[face]], geometry_.owner_offset[face]);
    if (mesh_.face_neighbour[face] >= 0)
      oblique_[2 * face + 1] = dot(gradient_[mesh_.face_neighbour[face]], geometry_.neighbour_offset[face]);
  }
  for (int correction = 0; correction < campaign_.dem.transient.corrections; ++correction) {
    set_resistance(solids, temperature);
    correct(solids, temperature, gas_before, flux_before, seconds);
    set_velocity();
  }
  finish(solids, flux_before, seconds);
}

TransientFlow::Side TransientFlow::side(const Solids& solids, std::int64_t cell, std::size_t face,
                                        double distance) const {
  const auto c = static_cast<std::size_t>(cell);
  const double e = void_fraction_[c];
  return {distance / e, distance * resistance_[c] / density_of_law_[c],
          distance * resistance_[c] * e * dot(solids.velocity[c], geometry_.normal[face]),
          dot(convection_[c], geometry_.normal[face])};
}

void TransientFlow::set_resistance(const Solids& solids, const std::vector<double>& temperature) {
  for (std::size_t cell = 0; cell < mesh_.cells(); ++cell) {
    resistance_[cell] = 0;
    if (!(solids.volume[cell] > 0)) continue;
    const double e = solids.bed.void_fraction[cell];
    Vector3 slip = velocity_[cell];
    add(slip, -1, solids.velocity[cell]);
    resistance_[cell] = drag_resistance(campaign_.drag, e, solids.bed.grain_diameter[cell],
                                        gas_viscosity(*campaign_.scene.gas, temperature[cell]), density_[cell],
                                        e * magnitude(slip), solids.bed.drag_factor[cell]);
  }
}

std::vector<double> TransientFlow::gas_by_volume() const {
  std::vector<double> gas(mesh_.cells());
  for (std::size_t cell = 0; cell < gas.size(); ++cell) gas[cell] = void_fraction_[cell] * density_[cell];
  return gas;
}

std::vector<double> TransientFlow::shear_exchange(const std::vector<double>& temperature, double seconds) {
  const std::size_t cells = mesh_.cells();
  std::vector<double> shear(cells);
  for (std::size_t cell = 0; cell < cells; ++cell) {
    shear[cell] = gas_viscosity(*campaign_.scene.gas, temperature[cell]);
    if (!eddy_viscosity_.empty()) shear[cell] += eddy_viscosity_[cell];
    shear[cell] *= void_fraction_[cell];
  }
  std::vector<double> exchange(mesh_.faces(), 0), of_cell(cells, 0);
  for (std::size_t face = 0; face < mesh_.faces(); ++face) {
    const auto owner = mesh_.face_owner[face];
    const auto neighbour = mesh_.face_neighbour[face];
    if (neighbour < 0) continue;
    exchange[face] = geometry_.area[face] / (geometry_.owner_distance[face] / shear[owner] +
                                             geometry_.neighbour_distance[face] / shear[neighbour]);
    of_cell[owner] += exchange[face];
    if (face < mesh_.internal_faces()) of_cell[neighbour] += exchange[face];
  }
  shear_limited_ = 0;
  if (eddy_viscosity_.empty()) return exchange;
  std::vector<double> share(cells, 1);
  for (std::size_t cell = 0; cell < cells; ++cell) {
    const double most =
        largest_shear_exchange * mesh_.cell_volume[cell] * void_fraction_[cell] * density_[cell] / seconds;
    if (of_cell[cell] <= most) continue;
    share[cell] = most / of_cell[cell];
    ++shear_limited_;
  }
  for (std::size_t face = 0; face < mesh_.faces(); ++face)
    if (mesh_.face_neighbour[face] >= 0)
      exchange[face] *= std::min(share[mesh_.face_owner[face]], share[mesh_.face_neighbour[face]]);
  return exchange;
}

std::vector<Vector3> TransientFlow::convection(const std::vector<double>& temperature, double seconds) {
  std::vector<Vector3> result(mesh_.cells(), Vector3{});
  const std::vector<double> shear = shear_exchange(temperature, seconds);
  for (std::size_t face = 0; face < mesh_.faces(); ++face) {
    const auto owner = mesh_.face_owner[face];
    const auto neighbour = mesh_.face_neighbour[face];
    const double out = std::max(0.0, flux_[face]);
    const double in = std::max(0.0, -flux_[face]);
    Vector3 beside = velocity_[owner];  // gas that flows back through the outlet has the cell's own velocity
    double exchange = 0;
    if (neighbour >= 0) {
      beside = velocity_[neighbour];
      exchange = shear[face];
    } else if (openings_.is_inlet(face)) {
      beside = {};
      add(beside, flux_[face] / (density_[owner] * geometry_.area[face]), geometry_.normal[face]);
    }
    add(result[owner], (out + exchange) / mesh_.cell_volume[owner], velocity_[owner]);
    add(result[owner], -(in + exchange) / mesh_.cell_volume[owner], beside);
    if (face >= mesh_.internal_faces()) continue;  // a periodic face's neighbour has a face of its own
    add(result[neighbour], (in + exchange) / mesh_.cell_volume[neighbour], beside);
    add(result[neighbour], -(out + exchange) / mesh_.cell_volume[neighbour], velocity_[owner]);
  }
  return result;
}

void TransientFlow::set_velocity() {
  velocity_ = geometry_.cell_vectors(mesh_, flux_);
  for (std::size_t cell = 0; cell < mesh_.cells(); ++cell)
    for (double& component : velocity_[cell]) component /= void_fraction_[cell] * density_[cell];
}

void TransientFlow::correct(const Solids& solids, const std::vector<double>& temperature,
                            const std::vector<double>& gas_before, const std::vector<double>& flux_before,
                            double seconds) {
  const std::size_t cells = mesh_.cells(), faces = mesh_.faces();
  const Gas& gas = *campaign_.scene.gas;
  density_of_law_ = density_;
  // The unknown is the pressure above the outlet's.
  std::vector<double> conductance(faces, 0), fixed(faces, 0);
  for (std::size_t face = 0; face < faces; ++face) {
    if (!through_flow(face)) {
      fixed[face] = openings_.flux(face);
      continue;
    }
    const double area = geometry_.area[face];
    const auto neighbour = mesh_.face_neighbour[face];
    const Side near = side(solids, mesh_.face_owner[face], face, geometry_.owner_distance[face]);
    const Side far = neighbour >= 0 ? side(solids, neighbour, face, geometry_.neighbour_distance[face]) : Side{};
    conductance[face] = area / ((near.inertia + far.inertia) / seconds + near.resistance + far.resistance);
    double push = near.push + far.push - near.inertia * near.convection - far.inertia * far.convection +
                  (near.inertia + far.inertia) * flux_before[face] / area / seconds + oblique_[2 * face];
    if (neighbour >= 0)
      push -= oblique_[2 * face + 1];
    else
      push -= std::sqrt(2 * openings_.psi(face) + gas.outlet_pressure * gas.outlet_pressure) - gas.outlet_pressure;
    fixed[face] = conductance[face] * push;
  }
  CellCoefficients coefficients{std::vector<double>(cells, 0), std::vector<double>(faces, 0),
                                std::vector<double>(mesh_.internal_faces(), 0), true};
  auto source = FaceGeometry::outflow(mesh_, fixed);
  std::vector<double> storage(cells), above(cells);
  for (std::size_t cell = 0; cell < cells; ++cell) {
    storage[cell] =
        mesh_.cell_volume[cell] * void_fraction_[cell] * gas_density(1, temperature[cell], gas.molar_mass) / seconds;
    coefficients.diagonal[cell] = storage[cell];
    above[cell] = pressure_[cell] - gas.outlet_pressure;
    source[cell] = gas_before[cell] / seconds - storage[cell] * gas.outlet_pressure - source[cell];
  }
  for (std::size_t face = 0; face < faces; ++face) {
    coefficients.diagonal[mesh_.face_owner[face]] += conductance[face];
    if (mesh_.face_neighbour[face] >= 0) coefficients.owner_row[face] = conductance[face];
    if (face < mesh_.internal_faces()) {
      coefficients.diagonal[mesh_.face_neighbour[face]] += conductance[face];
      coefficients.neighbour_row[face] = conductance[face];
    }
  }
  // What flows: the blast, or, where there is next to none, what parcels displace.
  double flows = blast_;
  for (const double flux : flux_before) flows = std::max(flows, std::abs(flux));
  mass_residual_ =
      equation_
          .solve("gas pressure", coefficients, source, above, step_tolerance * flows, acceptable_step_residual * flows)
          .residual /
      flows;
  for (std::size_t cell = 0; cell < cells; ++cell) {
    pressure_[cell] = gas.outlet_pressure + above[cell];
    if (!(pressure_[cell] > 0)) throw cell_failure(mesh_, "gas pressure is no longer positive", cell);
    density_[cell] = gas_density(pressure_[cell], temperature[cell], gas.molar_mass);
  }
  for (std::size_t face = 0; face < faces; ++face) {
    flux_[face] = fixed[face];
    if (!through_flow(face)) continue;
    const double beyond = mesh_.face_neighbour[face] >= 0 ? above[mesh_.face_neighbour[face]] : 0;
    flux_[face] += conductance[face] * (above[mesh_.face_owner[face]] - beyond);
  }
}

void TransientFlow::finish(const Solids& solids, const std::vector<double>& flux_before, double seconds) {
  drag_.assign(mesh_.cells(), Vector3{});
  force_of_solids_ = {};
  // The drag along a face's normal belongs to the part of the cell between its centre and the face: over the faces,
  // sum of area x (face - centre) x normal is the cell's volume.
  const auto count = [&](const Side& law, std::int64_t cell, std::size_t face, double distance, const Vector3& to_face,
                         double outwards, double pressure_fall) {
    const double area = geometry_.area[face];
    const double flux = flux_[face] / area;
    const double e = void_fraction_[cell];
    const double on_solids = e * (law.resistance * flux - law.push) / distance;
    const double on_gas = (flux - flux_before[face] / area) / seconds + law.convection - e * pressure_fall / distance;
    add(drag_[cell], outwards * area * on_solids / mesh_.cell_volume[cell], to_face);
    add(force_of_solids_, outwards * area * on_gas, to_face);
  };
  for (std::size_t face = 0; face < mesh_.faces(); ++face) {
    const auto owner = mesh_.face_owner[face];
    const auto neighbour = mesh_.face_neighbour[face];
    const double area = geometry_.area[face];
    const double to_owner = geometry_.owner_distance[face];
    const Side near = side(solids, owner, face, to_owner);
    const double at_owner = pressure_[owner] + oblique_[2 * face];
    const double near_fall = fall(near, flux_[face] / area, flux_before[face] / area, seconds);
    face_pressure_[face] = at_owner - near_fall;
    Vector3 way = geometry_.owner_offset[face];
    add(way, to_owner, geometry_.normal[face]);
    count(near, owner, face, to_owner, way, 1, at_owner - face_pressure_[face]);
    if (face >= mesh_.internal_faces()) continue;
    const double to_neighbour = geometry_.neighbour_distance[face];
    way = geometry_.neighbour_offset[face];
    add(way, -to_neighbour, geometry_.normal[face]);
    count(side(solids, neighbour, face, to_neighbour), neighbour, face, to_neighbour, way, -1,
          face_pressure_[face] - (pressure_[neighbour] + oblique_[2 * face + 1]));
  }
  gradient_ = FaceGeometry::surface_gradient(mesh_, face_pressure_);
}

double TransientFlow::crossing_time() const {
  std::vector<double> passing(mesh_.cells(), 0);  // kg/s in and out
  for (std::size_t face = 0; face < mesh_.faces(); ++face) {
    passing[mesh_.face_owner[face]] += std::abs(flux_[face]);
    if (face < mesh_.internal_faces()) passing[mesh_.face_neighbour[face]] += std::abs(flux_[face]);
  }
  double fastest = 0;  // 1/s
  for (std::size_t cell = 0; cell < mesh_.cells(); ++cell)
    fastest = std::max(fastest, passing[cell] / (mesh_.cell_volume[cell] * void_fraction_[cell] * density_[cell]));
  return fastest > 0 ? 2 / fastest : std::numeric_limits<double>::infinity();
}

std::vector<BedFlow::NamedInlet> TransientFlow::inlets() const {
  std::vector<BedFlow::NamedInlet> result;
  const auto flows = openings_.mass_flow(flux_);
  const auto pressures = openings_.mean(face_pressure_);
  for (std::size_t i = 0; i < flows.size(); ++i)
    result.push_back({openings_.inlets()[i].name, openings_.state(i, std::max(0.0, flows[i]), pressures[i]), flows[i],
                      openings_.smallest_opening(i, flows[i], pressures[i])});
  return result;
}

TransientFlow::Memory TransientFlow::memory() const {
  return {pressure_, flux_, void_fraction_, density_, face_pressure_};
}

void TransientFlow::restore(Memory memory) {
  pressure_ = std::move(memory.pressure);
  flux_ = std::move(memory.face_mass_flux);
  void_fraction_ = std::move(memory.void_fraction);
  density_ = std::move(memory.gas_density);
  face_pressure_ = std::move(memory.face_pressure);
  set_velocity();
  gradient_ = FaceGeometry::surface_gradient(mesh_, face_pressure_);
}

}  // namespace cupola
