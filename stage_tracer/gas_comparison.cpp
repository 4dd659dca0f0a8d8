#include "stage_tracer/gas_comparison.hpp"

#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <limits>

#include "schemas/failure.hpp"

namespace cupola {
namespace {

constexpr double tolerance = 1e-5;
constexpr int most_iterations = 300;
/// Limits of the rows, m from the nearest inlet.
constexpr std::array<double, 7> limits{0, 0.5, 1, 1.5, 2, 2.5, std::numeric_limits<double>::infinity()};

std::vector<double> distance_to_inlets(const BedMesh& mesh) {
  std::vector<double> distance(mesh.cells(), std::numeric_limits<double>::infinity());
  for (const auto& patch : mesh.patches) {
    if (patch.kind != BedMesh::PatchKind::inlet) continue;
    for (auto face = patch.first_face; face < patch.first_face + patch.faces; ++face) {
      const Vector3& mouth = mesh.face_centre[face];
      for (std::size_t c = 0; c < mesh.cells(); ++c) {
        const Vector3& x = mesh.cell_centre[c];
        distance[c] = std::min(distance[c], std::hypot(x[0] - mouth[0], x[1] - mouth[1], x[2] - mouth[2]));
      }
    }
  }
  return distance;
}

struct Sums {
  double cells = 0, flux_difference = 0, flux = 0, pressure_difference = 0, rise = 0;
};

}  // namespace

nlohmann::json compare_gas_models(FoamCase& foam, const BedMesh& mesh, const Campaign& campaign, const BedState& bed,
                                  const std::vector<double>& temperature) {
  const auto seconds_of = [&](BedFlow& flow, BedFlow::Result& result) {
    const auto begin = std::chrono::steady_clock::now();
    result = flow.solve(bed, temperature, tolerance, most_iterations);
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
  };
  DarcyForchheimer darcy(foam, mesh, campaign);
  NavierStokes navier(foam, mesh, campaign);
  BedFlow::Result of_darcy, of_navier;
  nlohmann::json report;
  try {
    report["seconds"]["darcy_forchheimer"] = seconds_of(darcy, of_darcy);
    report["seconds"]["navier_stokes"] = seconds_of(navier, of_navier);
  } catch (const Failure& failure) {
    return {{"failed", failure.what()}};
  }
  report["iterations"] = {{"darcy_forchheimer", of_darcy.iterations}, {"navier_stokes", of_navier.iterations}};
  const std::vector<double> distance = distance_to_inlets(mesh);
  std::array<Sums, limits.size() - 1> rows{};
  for (std::size_t c = 0; c < mesh.cells(); ++c) {
    // In the freeboard Darcy and Forchheimer's field means nothing.
    if (bed.void_fraction[c] > 1 - 1e-6) continue;
    std::size_t row = 0;
    while (row + 1 < rows.size() && distance[c] >= limits[row + 1]) ++row;
    Sums& sums = rows[row];
    const double v = mesh.cell_volume[c];
    sums.cells += 1;
    for (std::size_t k = 0; k < 3; ++k) {
      const double a = darcy.mass_flux()[c][k], b = navier.mass_flux()[c][k];
      sums.flux += v * a * a;
      sums.flux_difference += v * (a - b) * (a - b);
    }
    const double rise = darcy.pressure()[c] - campaign.scene.gas->outlet_pressure;
    const double difference = darcy.pressure()[c] - navier.pressure()[c];
    sums.rise += v * rise * rise;
    sums.pressure_difference += v * difference * difference;
  }
  report["rows"] = nlohmann::json::array();
  for (std::size_t row = 0; row < rows.size(); ++row) {
    const Sums& sums = rows[row];
    if (sums.cells == 0) continue;
    const bool last = row + 1 == rows.size();
    report["rows"].push_back({{"from", limits[row]},
                              {"to", last ? nlohmann::json(nullptr) : nlohmann::json(limits[row + 1])},
                              {"cells", sums.cells},
                              {"mass_flux", std::sqrt(sums.flux_difference / sums.flux)},
                              {"pressure", std::sqrt(sums.pressure_difference / sums.rise)}});
  }
  return report;
}

}  // namespace cupola
