// Cost of a path's crossing of one cell: tracers through a recirculating field on the slot's trapezoids.
// Prints one JSON object.
#include <fmt/format.h>

#include <cmath>
#include <ctime>
#include <numbers>
#include <random>

#include "physics/motion/path.hpp"
#include "tests/support/structured_mesh.hpp"

namespace {

using namespace cupola;

StructuredMesh slot() {
  return structured_mesh({64, 11, 152}, 1.2, [](const Vector3& r) {
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

}  // namespace

int main() {
  const StructuredMesh structured = slot();
  const BedMesh& mesh = structured.mesh;
  const PathField field(mesh, fluxes(mesh), std::vector<double>(mesh.cells(), 0.56));
  std::mt19937_64 random(1);
  std::uniform_real_distribution<double> unit(0, 1);
  constexpr int tracers = 50000;
  std::vector<PathField::Point> points;
  for (int i = 0; i < tracers; ++i) {
    points.push_back({static_cast<std::int64_t>(unit(random) * static_cast<double>(mesh.cells())),
                      {unit(random), unit(random), unit(random)}});
  }
  const auto count = [](void* counter, std::int64_t, double) { ++*static_cast<std::int64_t*>(counter); };
  const auto timed = [&](double seconds) {
    std::int64_t stays = 0;
    const std::clock_t begin = std::clock();  // of this process: other work on the machine does not count
    for (PathField::Point& point : points) field.advance(point, seconds, +count, &stays);
    const double nanoseconds = 1e9 * static_cast<double>(std::clock() - begin) / CLOCKS_PER_SEC;
    return std::pair{nanoseconds / static_cast<double>(stays), static_cast<double>(stays) / tracers};
  };
  timed(0.1);
  const auto [long_step, long_stays] = timed(5.0);
  const auto [short_step, short_stays] = timed(0.05);
  fmt::print(
      R"({{"bench": "motion", "cells": {}, "tracers": {}, "nanoseconds_a_stay": {:.1f}, "stays_a_step": {:.1f}, )"
      R"("nanoseconds_a_stay_short_steps": {:.1f}, "stays_a_short_step": {:.1f}, "fallbacks": {}}})"
      "\n",
      mesh.cells(), tracers, long_step, long_stays, short_step, short_stays, field.fallbacks());
}
