#include "stage_tracer/conduction.hpp"

#include <algorithm>
#include <cmath>

#include "physics/closures/carson.hpp"
#include "physics/closures/gas_state.hpp"
#include "physics/closures/layer_exchange.hpp"
#include "physics/closures/zehner_bauer_schluender.hpp"

namespace cupola {
namespace {

// K; the fluxes of the solution are applied, so that heat is kept whatever it is.
constexpr double step_tolerance = 1e-4;
constexpr double steady_tolerance = 1e-6;

/// Area over the distance of the cell centres along the face normal.
double area_over_distance(const BedMesh& mesh, std::size_t face, std::int64_t other_face, std::int64_t neighbour) {
  const Vector3& area = mesh.face_area[face];
  double square = 0;
  double along = 0;
  for (std::size_t k = 0; k < 3; ++k) {
    const double to_face = mesh.face_centre[face][k] - mesh.cell_centre[mesh.face_owner[face]][k];
    const double from_face = mesh.cell_centre[neighbour][k] - mesh.face_centre[other_face][k];
    square += area[k] * area[k];
    along += area[k] * (to_face + from_face);
  }
  return square / along;
}

}  // namespace

Conduction::Conduction(const BedMesh& mesh, const Campaign& campaign, const std::vector<bool>& bed,
                       std::vector<double> thickness, std::vector<double> recipe_share)
    : mesh_(mesh),
      campaign_(campaign),
      bed_(bed),
      thickness_(std::move(thickness)),
      recipe_share_(std::move(recipe_share)) {
  for (std::size_t f = 0; f < mesh.faces(); ++f) {
    const std::int64_t owner = mesh.face_owner[f];
    const std::int64_t neighbour = mesh.face_neighbour[f];
    if (neighbour < 0 || neighbour == owner || !bed[owner] || !bed[neighbour]) continue;
    const std::int64_t partner = mesh.face_partner[f];
    if (partner >= 0 && partner < static_cast<std::int64_t>(f)) continue;  // a periodic pair counts once
    const std::int64_t other_face = partner >= 0 ? partner : static_cast<std::int64_t>(f);
    neighbours_.push_back({owner, neighbour, area_over_distance(mesh, f, other_face, neighbour)});
  }
  const auto& loss = campaign.scene.heat_loss;
  if (!loss || loss->on == WallHeatLoss::On::gas) return;
  wall_.assign(mesh.cells(), 0.0);
  for (const auto& patch : mesh.patches) {
    if (patch.kind != BedMesh::PatchKind::wall) continue;
    for (auto face = patch.first_face; face < patch.first_face + patch.faces; ++face) {
      const Vector3& area = mesh.face_area[face];
      if (bed[mesh.face_owner[face]])
        wall_[mesh.face_owner[face]] += loss->coefficient * std::hypot(area[0], area[1], area[2]);
    }
  }
}

BySpecies Conduction::shares(const CellContents& contents, const BySpecies& bed_volume) const {
  BySpecies share = bed_volume;
  for (std::size_t c = 0; c < mesh_.cells(); ++c) {
    double solids = 0;
    for (const auto& volume : bed_volume) solids += volume[c];
    // Zero where no tracer holds its heat.
    for (std::size_t s = 0; s < share.size(); ++s)
      share[s][c] = solids > 0 && contents.volume[s][c] > 1e-9 * mesh_.cell_volume[c] ? share[s][c] / solids : 0;
  }
  return share;
}

BySpecies Conduction::conductivities(const CellContents& contents, const BySpecies& bed_volume) const {
  const std::size_t species = campaign_.species.size();
  BySpecies result(species, std::vector<double>(mesh_.cells()));
  const Heat heat = campaign_.heat.value_or(Heat{});
  const bool with_gas = heat.bed_conduction == Heat::BedConduction::zehner_bauer_schluender && campaign_.scene.gas;
  const GasState gas(campaign_.scene.gas.value_or(Gas{}));
  for (std::size_t c = 0; c < mesh_.cells(); ++c) {
    double fraction = 0;
    for (const auto& volume : bed_volume) fraction += volume[c] / mesh_.cell_volume[c];
    for (std::size_t s = 0; s < species; ++s) {
      const Species& material = campaign_.species[s];
      // A species that is not there has no temperature and conducts nothing.
      if (!(contents.volume[s][c] > 0)) continue;
      const double temperature = contents.temperature[s][c];
      const double solid = material.conductivity.at(temperature);
      result[s][c] = with_gas
                         ? bed_conductivity_zehner_bauer_schluender(
                               {solid, gas.conductivity(temperature), material.diameter, heat.emissivity, temperature},
                               1 - fraction)
                         : bed_conductivity_carson(solid, fraction);
    }
  }
  return result;
}

void Conduction::link_within_species(const BySpecies& share, const BySpecies& conductivity,
                                     std::vector<Link>& result) const {
  const std::size_t cells = mesh_.cells();
  for (std::size_t s = 0; s < share.size(); ++s) {
    for (const Neighbours& pair : neighbours_) {
      const double a = conductivity[s][pair.first];
      const double b = conductivity[s][pair.second];
      const double overlap = std::min(share[s][pair.first], share[s][pair.second]);
      if (a <= 0 || b <= 0 || overlap <= 0) continue;
      result.push_back({s * cells + static_cast<std::size_t>(pair.first),
                        s * cells + static_cast<std::size_t>(pair.second),
                        overlap * 2 * a * b / (a + b) * pair.area_over_distance});
    }
  }
}

void Conduction::link_layers(const BySpecies& share, const BySpecies& conductivity, std::vector<Link>& result) const {
  const std::size_t cells = mesh_.cells();
  for (std::size_t a = 0; a < share.size(); ++a) {
    for (std::size_t b = a + 1; b < share.size(); ++b) {
      const double recipe = recipe_share_[a] * recipe_share_[b];
      if (recipe <= 0) continue;
      for (std::size_t c = 0; c < cells; ++c) {
        const double weight = std::min(1.0, share[a][c] * share[b][c] / recipe);
        if (weight <= 0) continue;
        const double exchange = layer_exchange(thickness_[a], conductivity[a][c], thickness_[b], conductivity[b][c]);
        if (exchange > 0) result.push_back({a * cells + c, b * cells + c, weight * exchange * mesh_.cell_volume[c]});
      }
    }
  }
}

void Conduction::link_mixture(const BySpecies& share, const BySpecies& conductivity, std::vector<Link>& result) const {
  const std::size_t cells = mesh_.cells();
  // Carson's factor is the same for all species of a cell.
  const auto mixed = [&](std::int64_t cell) {
    double sum = 0;
    for (std::size_t s = 0; s < share.size(); ++s) sum += share[s][cell] * conductivity[s][cell];
    return sum;
  };
  for (const Neighbours& pair : neighbours_) {
    const double a = mixed(pair.first), b = mixed(pair.second);
    if (a <= 0 || b <= 0) continue;
    const double whole = 2 * a * b / (a + b) * pair.area_over_distance;
    for (std::size_t s = 0; s < share.size(); ++s) {
      for (std::size_t t = 0; t < share.size(); ++t) {
        const double part = share[s][pair.first] * share[t][pair.second];
        if (part > 0) {
          result.push_back({s * cells + static_cast<std::size_t>(pair.first),
                            t * cells + static_cast<std::size_t>(pair.second), part * whole});
        }
      }
    }
  }
}

std::vector<Link> Conduction::links(const CellContents& contents, const BySpecies& bed_volume) const {
  const BySpecies share = shares(contents, bed_volume);
  const BySpecies conductivity = conductivities(contents, bed_volume);
  std::vector<Link> result;
  if (campaign_.heat && campaign_.heat->bed_conduction == Heat::BedConduction::mixture) {
    link_mixture(share, conductivity, result);
    return result;
  }
  link_within_species(share, conductivity, result);
  link_layers(share, conductivity, result);
  return result;
}

std::vector<double> Conduction::wall_conductance(const CellContents& contents, const BySpecies& bed_volume) const {
  const std::size_t cells = mesh_.cells();
  std::vector<double> result(campaign_.species.size() * cells, 0.0);
  if (wall_.empty()) return result;
  const BySpecies share = shares(contents, bed_volume);
  const bool both = campaign_.scene.heat_loss->on == WallHeatLoss::On::both;
  for (std::size_t c = 0; c < cells; ++c) {
    if (wall_[c] <= 0) continue;
    double solids = 0;
    for (const auto& volume : bed_volume) solids += volume[c] / mesh_.cell_volume[c];
    for (std::size_t s = 0; s < share.size(); ++s)
      result[s * cells + c] = wall_[c] * share[s][c] * (both ? std::min(1.0, solids) : 1.0);
  }
  return result;
}

Conduction::Result Conduction::advance(const CellContents& contents, const BySpecies& capacity,
                                       const BySpecies& bed_volume, double step) const {
  const std::size_t cells = mesh_.cells();
  const std::size_t species = campaign_.species.size();
  const std::vector<double> wall = wall_conductance(contents, bed_volume);
  const double outside = campaign_.scene.heat_loss ? campaign_.scene.heat_loss->ambient : 0;
  std::vector<double> temperature(species * cells);
  std::vector<double> diagonal(species * cells);
  std::vector<double> source(species * cells);
  for (std::size_t s = 0; s < species; ++s) {
    for (std::size_t c = 0; c < cells; ++c) {
      const std::size_t i = s * cells + c;
      temperature[i] = contents.temperature[s][c];
      diagonal[i] = capacity[s][c] / step + wall[i];
      source[i] = capacity[s][c] / step * temperature[i] + wall[i] * outside;
    }
  }
  const std::vector<Link> network = links(contents, bed_volume);
  Result result;
  result.iterations = solve_network(network, diagonal, source, temperature, step_tolerance);
  const std::vector<double> inflow = network_inflow(network, temperature);
  std::vector<double> conductance = wall;
  for (const Link& link : network) {
    conductance[link.first] += link.conductance;
    conductance[link.second] += link.conductance;
  }
  result.change.assign(species, std::vector<double>(cells, 0.0));
  result.damping = result.change;
  for (std::size_t s = 0; s < species; ++s) {
    for (std::size_t c = 0; c < cells; ++c) {
      const std::size_t i = s * cells + c;
      const double holds = capacity[s][c];
      if (holds <= 0) continue;
      const double lost = wall[i] * (temperature[i] - outside);
      result.walls += lost * step;
      result.change[s][c] = (inflow[i] - lost) * step / holds;
      const double stiffness = conductance[i] * step / holds;
      result.damping[s][c] = std::max(0.0, (stiffness - 1) / (stiffness + 1));
    }
  }
  return result;
}

BySpecies Conduction::steady(const CellContents& contents, const BySpecies& bed_volume, const std::vector<bool>& free,
                             const BySpecies& gas_conductance, const BySpecies& gas_temperature) const {
  const std::size_t cells = mesh_.cells();
  const std::size_t species = campaign_.species.size();
  const std::vector<Link> network = links(contents, bed_volume);
  std::vector<double> temperature(species * cells);
  const std::vector<double> wall = wall_conductance(contents, bed_volume);
  const double outside = campaign_.scene.heat_loss ? campaign_.scene.heat_loss->ambient : 0;
  std::vector<double> diagonal(species * cells, 0.0);
  std::vector<double> source(species * cells, 0.0);
  for (std::size_t i = 0; i < temperature.size(); ++i) {
    const std::size_t s = i / cells;
    const std::size_t c = i % cells;
    temperature[i] = contents.temperature[s][c];
    if (!free[c]) continue;
    diagonal[i] = gas_conductance[s][c] + wall[i];
    source[i] = gas_conductance[s][c] * gas_temperature[s][c] + wall[i] * outside;
  }
  // Held nodes are boundary values: their links become diagonal and source of the free ones.
  std::vector<Link> between_free;
  for (const Link& link : network) {
    const bool first_free = free[link.first % cells];
    const bool second_free = free[link.second % cells];
    if (first_free && second_free) {
      between_free.push_back(link);
    } else if (first_free || second_free) {
      const std::size_t node = first_free ? link.first : link.second;
      const std::size_t held = first_free ? link.second : link.first;
      diagonal[node] += link.conductance;
      source[node] += link.conductance * temperature[held];
    }
  }
  solve_network(between_free, diagonal, source, temperature, steady_tolerance);
  BySpecies result(species, std::vector<double>(cells));
  for (std::size_t i = 0; i < temperature.size(); ++i) result[i / cells][i % cells] = temperature[i];
  return result;
}

}  // namespace cupola
