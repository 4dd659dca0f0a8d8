#include "stage_tracer/displacement.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

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

std::int64_t displace(Tracers& tracers, const TracerSettings& settings, const CellLocator& locator,
                      const PathField& paths, const std::vector<bool>& bed, const std::vector<double>& excess,
                      double seconds, std::uint64_t seed, long step) {
  std::int64_t held = 0;
  for (std::size_t i = 0; i < tracers.size(); ++i) {
    const PathField::Point& point = tracers.point[i];
    const double e = excess[point.cell];
    if (e <= 0) continue;
    const auto uniform = random_uniform(seed, RandomUse::displacement, static_cast<std::uint64_t>(tracers.id[i]),
                                        static_cast<std::uint32_t>(step));
    const double length =
        std::min(std::sqrt(6 * settings.displacement_coefficient * e * seconds), settings.displacement_limit);
    const double cosine = 2 * uniform[0] - 1;
    const double sine = std::sqrt(1 - cosine * cosine);
    const double angle = 2 * std::numbers::pi * uniform[1];
    Vector3 position = paths.position(point);
    position[0] += length * sine * std::cos(angle);
    position[1] += length * sine * std::sin(angle);
    position[2] += length * cosine;
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
