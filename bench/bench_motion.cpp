// Cost of a path's crossing of one cell: tracers through a recirculating field on the slot's trapezoids.
//   bench_motion [--json FILE]
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <ctime>
#include <fstream>
#include <nlohmann/json.hpp>
#include <random>
#include <string>

#include "physics/motion/path.hpp"
#include "tests/support/structured_mesh.hpp"

namespace {

using namespace cupola;

StructuredMesh slot(double refinement) {
  const auto count = [&](int cells) { return std::max(1, static_cast<int>(std::lround(cells * refinement))); };
  return structured_mesh({count(64), count(11), count(152)}, 1.2, [](const Vector3& r) {
    const double z = 28 * r[2];
    const double half_width = z < 6 ? 6 + 0.2 * z : 7.2 - 0.12 * (z - 6);
    return Vector3{half_width * (2 * r[0] - 1), 1.2 * (r[1] - 0.5), z};
  });
}

/// Descent with cells of convection over it, not uniform anywhere.
std::vector<double> fluxes(const BedMesh& mesh) {
  std::vector<double> flux(mesh.faces());
  for (std::size_t face = 0; face < mesh.faces(); ++face) {
    const Vector3& a = mesh.face_area[face];
    const Vector3& c = mesh.face_centre[face];
    const double x = std::sin(c[0]) * std::cos(0.7 * c[2]);
    const double z = -0.3 - std::cos(c[0]) * std::sin(0.7 * c[2]) / 0.7;
    flux[face] = x * a[0] + 0.1 * std::sin(c[2]) * a[1] + z * a[2];
  }
  for (const BedMesh::Patch& patch : mesh.patches) {
    for (std::int64_t i = 0; patch.kind != BedMesh::PatchKind::periodic && i < patch.faces; ++i) {
      flux[static_cast<std::size_t>(patch.first_face + i)] = 0;
    }
  }
  return flux;
}

struct Cost {
  double a_stay = 0;    ///< ns
  double a_tracer = 0;  ///< ns
  double stays = 0;     ///< a tracer and step
};

class Bench {
 public:
  explicit Bench(double refinement)
      : structured_(slot(refinement)), field_(mesh(), fluxes(mesh()), std::vector<double>(mesh().cells(), 0.56)) {}

  [[nodiscard]] const BedMesh& mesh() const { return structured_.mesh; }

  /// Several steps of tracers at random places, in the order of their cells or not.
  [[nodiscard]] Cost move(std::size_t tracers, bool sorted, double seconds) const {
    std::mt19937_64 random(1);
    std::uniform_real_distribution<double> unit(0, 1);
    std::vector<PathField::Point> points;
    for (std::size_t i = 0; i < tracers; ++i) {
      points.push_back({static_cast<std::int64_t>(unit(random) * static_cast<double>(mesh().cells())),
                        {unit(random), unit(random), unit(random)}});
    }
    if (sorted) std::sort(points.begin(), points.end(), [](const auto& a, const auto& b) { return a.cell < b.cell; });
    std::int64_t stays = 0;
    auto counted = points;
    const auto count = [](void* counter, std::int64_t, double) { ++*static_cast<std::int64_t*>(counter); };
    for (PathField::Point& point : counted) field_.advance(point, seconds, +count, &stays);
    std::vector<PathField::Stay> kept;
    const auto repeats = std::max<std::size_t>(1, 400000 / tracers);
    const std::clock_t begin = std::clock();  // of this process: other work on the machine does not count
    for (std::size_t k = 0; k < repeats; ++k) {
      kept.clear();
      for (PathField::Point& point : points) field_.advance(point, seconds, kept);
    }
    const double nanoseconds =
        1e9 * static_cast<double>(std::clock() - begin) / CLOCKS_PER_SEC / static_cast<double>(repeats);
    return {nanoseconds / static_cast<double>(stays), nanoseconds / static_cast<double>(tracers),
            static_cast<double>(stays) / static_cast<double>(tracers)};
  }

 private:
  StructuredMesh structured_;
  PathField field_;
};

/// Slope of log cost over log size from the smallest to the largest.
double exponent(const std::vector<std::pair<double, double>>& cost) {
  return std::log(cost.back().second / cost.front().second) / std::log(cost.back().first / cost.front().first);
}

}  // namespace

int main(int argc, char** argv) {
  auto rows = nlohmann::json::array();
  const auto add = [&](const std::string& metric, double value, const std::string& unit, std::size_t cells,
                       std::size_t tracers) {
    rows.push_back({{"bench", "motion"},
                    {"setting", "default"},
                    {"metric", metric},
                    {"value", value},
                    {"unit", unit},
                    {"ranks", 1},
                    {"cells", cells},
                    {"parcels", tracers}});
    fmt::print("{:<52} {:>10.4g} {:<3} {:>7} cells {:>8} tracers\n", metric, value, unit, cells, tracers);
  };
  constexpr std::size_t usual = 100000;
  constexpr double short_step = 0.05;  // about a tenth of a cell, as in the tracer stage
  constexpr double long_step = 5;
  {
    const Bench bench(1);
    const std::size_t cells = bench.mesh().cells();
    for (const bool sorted : {true, false}) {
      const std::string order = sorted ? "in the order of cells" : "in random order";
      const Cost brief = bench.move(usual, sorted, short_step);
      const Cost far = bench.move(usual, sorted, long_step);
      add("nanoseconds a tracer, short step, " + order, brief.a_tracer, "ns", cells, usual);
      add("nanoseconds a stay, long step, " + order, far.a_stay, "ns", cells, usual);
      add("stays a long step, " + order, far.stays, "1", cells, usual);
    }
    std::vector<std::pair<double, double>> cost;
    for (const std::size_t tracers : {std::size_t{10000}, usual, std::size_t{1000000}}) {
      const double each = bench.move(tracers, true, short_step).a_tracer;
      add("nanoseconds a tracer, short step, growing number", each, "ns", cells, tracers);
      cost.emplace_back(static_cast<double>(tracers), each * static_cast<double>(tracers));
    }
    add("exponent in tracers", exponent(cost), "1", cells, 1000000);
  }
  std::vector<std::pair<double, double>> cost;
  for (const double refinement : {0.46, 1.0, 1.55}) {
    const Bench bench(refinement);
    const std::size_t cells = bench.mesh().cells();
    const double each = bench.move(cells, true, short_step).a_tracer;
    add("nanoseconds a tracer, short step, one a cell", each, "ns", cells, cells);
    cost.emplace_back(static_cast<double>(cells), each * static_cast<double>(cells));
  }
  add("exponent in cells", exponent(cost), "1", static_cast<std::size_t>(cost.back().first),
      static_cast<std::size_t>(cost.back().first));
  if (argc == 3 && std::string(argv[1]) == "--json") std::ofstream(argv[2]) << rows.dump(1);
}
