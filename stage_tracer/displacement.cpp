#include "stage_tracer/displacement.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "physics/equations/face_geometry.hpp"
#include "stage_tracer/network.hpp"
#include "stage_tracer/random.hpp"

namespace cupola {

std::vector<double> volume_excess(const BedMesh& mesh, const std::vector<bool>& bed,
                                  const std::vector<double>& tracer_volume,
                                  const std::vector<double>& solids_fraction) {
  std::vector<double> excess(mesh.cells(), 0.0);
  for (std::size_t c = 0; c < mesh.cells(); ++c) {
    const double packed = tracer_volume[c] / mesh.cell_volume[c];
    if (bed[c] && packed > solids_fraction[c]) excess[c] = (packed - solids_fraction[c]) / packed;
  }
  return excess;
}

std::vector<bool> displaced_cells(const BedMesh& mesh, const Campaign& campaign, const std::vector<bool>& bed,
                                  const std::vector<double>& ore_temperature) {
  const DisplacementExcludes& excludes = campaign.tracer.displacement_excludes;
  double none_below = -std::numeric_limits<double>::infinity();
  double melted = 0;
  for (const Species& species : campaign.species) {
    if (!species.softening) continue;
    none_below = std::max(none_below, species.none_below);
    melted = std::max(melted, species.softening->melted);
  }
  const bool zone_counts = excludes.above_cohesive_zone && melted > 0 && !ore_temperature.empty();
  std::vector<bool> displaced = bed;
  for (std::size_t c = 0; c < mesh.cells(); ++c) {
    const Vector3& centre = mesh.cell_centre[c];
    if (zone_counts && centre[2] > none_below && ore_temperature[c] < melted) displaced[c] = false;
    for (const auto& box : excludes.boxes) {
      bool inside = true;
      for (std::size_t k = 0; k < 3; ++k) inside = inside && centre[k] >= box[0][k] && centre[k] <= box[1][k];
      if (inside) displaced[c] = false;
    }
  }
  return displaced;
}

std::vector<Vector3> relaxation(const BedMesh& mesh, const std::vector<bool>& displaced,
                                const std::vector<double>& tracer_volume, const std::vector<double>& solids_fraction,
                                const TracerSettings& settings, double seconds) {
  constexpr double tolerance = 1e-8;  // of a volume fraction
  const std::size_t cells = mesh.cells();
  const FaceGeometry geometry(mesh);
  const double reach = settings.relaxation_coefficient * seconds;  // m2
  std::vector<Link> links;
  const auto other_side = [&](std::size_t face) {
    const std::int64_t owner = mesh.face_owner[face];
    const std::int64_t neighbour = mesh.face_neighbour[face];
    return neighbour >= 0 && neighbour != owner && displaced[owner] && displaced[neighbour] ? neighbour
                                                                                            : std::int64_t{-1};
  };
  for (std::size_t f = 0; f < mesh.faces(); ++f) {
    const std::int64_t neighbour = other_side(f);
    const std::int64_t partner = mesh.face_partner[f];
    if (neighbour < 0 || (partner >= 0 && partner < static_cast<std::int64_t>(f))) continue;
    links.push_back({static_cast<std::size_t>(mesh.face_owner[f]), static_cast<std::size_t>(neighbour),
                     reach * geometry.area[f] / (geometry.owner_distance[f] + geometry.neighbour_distance[f])});
  }
  std::vector<double> lack(cells, 0.0);
  std::vector<double> source(cells, 0.0);
  for (std::size_t c = 0; c < cells; ++c) {
    if (displaced[c]) lack[c] = solids_fraction[c] - tracer_volume[c] / mesh.cell_volume[c];
    source[c] = mesh.cell_volume[c] * lack[c];
  }
  solve_network(links, mesh.cell_volume, source, lack, tolerance);
  // Gauss: values of faces by the distances of the centres, the cell's own where nothing is displaced beyond.
  std::vector<Vector3> result(cells, Vector3{});
  for (std::size_t f = 0; f < mesh.faces(); ++f) {
    const std::int64_t owner = mesh.face_owner[f];
    const std::int64_t neighbour = other_side(f);
    double value = lack[owner];
    if (neighbour >= 0) {
      const double span = geometry.owner_distance[f] + geometry.neighbour_distance[f];
      value = (lack[owner] * geometry.neighbour_distance[f] + lack[neighbour] * geometry.owner_distance[f]) / span;
    }
    for (std::size_t k = 0; k < 3; ++k) result[owner][k] += value * mesh.face_area[f][k];
    if (f >= mesh.internal_faces()) continue;  // a periodic side is a face of either cell
    const std::int64_t beyond = mesh.face_neighbour[f];
    if (neighbour < 0) value = lack[beyond];
    for (std::size_t k = 0; k < 3; ++k) result[beyond][k] -= value * mesh.face_area[f][k];
  }
  for (std::size_t c = 0; c < cells; ++c) {
    const double packed = tracer_volume[c] / mesh.cell_volume[c];
    if (!displaced[c] || packed <= 0) {
      result[c] = {};
      continue;
    }
    double square = 0;
    for (double& component : result[c]) {
      component *= reach / mesh.cell_volume[c] / packed;
      square += component * component;
    }
    const double length = std::sqrt(square);
    if (length > settings.relaxation_limit) {
      for (double& component : result[c]) component *= settings.relaxation_limit / length;
    }
  }
  return result;
}

std::int64_t displace(Tracers& tracers, const TracerSettings& settings, const CellLocator& locator,
                      const PathField& paths, const std::vector<bool>& bed, const std::vector<double>& excess,
                      double seconds, std::uint64_t seed, long step, const std::vector<Vector3>& relaxation) {
  std::int64_t held = 0;
  for (std::size_t i = 0; i < tracers.size(); ++i) {
    const PathField::Point& point = tracers.point[i];
    const double e = excess[point.cell];
    Vector3 way{};
    if (!relaxation.empty()) way = relaxation[point.cell];
    if (e > 0) {
      const auto uniform = random_uniform(seed, RandomUse::displacement, static_cast<std::uint64_t>(tracers.id[i]),
                                          static_cast<std::uint32_t>(step));
      const double length =
          std::min(std::sqrt(6 * settings.displacement_coefficient * e * seconds), settings.displacement_limit);
      const double cosine = 2 * uniform[0] - 1;
      const double sine = std::sqrt(1 - cosine * cosine);
      const double angle = 2 * std::numbers::pi * uniform[1];
      way[0] += length * sine * std::cos(angle);
      way[1] += length * sine * std::sin(angle);
      way[2] += length * cosine;
    }
    if (way == Vector3{}) continue;
    Vector3 position = paths.position(point);
    for (std::size_t k = 0; k < 3; ++k) position[k] += way[k];
    const std::int64_t cell = locator.find(position, point.cell);
    if (cell < 0 || !bed[cell]) {
      ++held;
      continue;
    }
    tracers.point[i] = paths.locate_in(cell, position);
  }
  return held;
}

}  // namespace cupola
