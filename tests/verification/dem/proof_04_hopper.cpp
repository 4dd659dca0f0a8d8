// Discharge of a flat-bottomed hopper through a slot.
#include <gtest/gtest.h>
#include <mpi.h>

#include <algorithm>
#include <cmath>
#include <fstream>

#include "stage_dem/liggghts_engine.hpp"
#include "tests/verification/dem/proof_scene.hpp"

namespace cupola::test {
namespace {

constexpr double d = 0.02;        // m, of the grains
constexpr double density = 2500;  // kg/m3
constexpr double half_width = 7 * d;
constexpr double depth = 4.2 * d;       // periodic
constexpr double floor_height = 9 * d;  // of the flat bottom above the domain's: what has fallen lies below it

/// A rectangle from corner along a and b, in triangles of about two grains.
void write_rectangle(std::ofstream& file, const Vector3& corner, const Vector3& a, const Vector3& b) {
  const auto parts = [](const Vector3& side) {
    return std::max(1, static_cast<int>(std::hypot(side[0], side[1], side[2]) / (3 * d)));
  };
  const int m = parts(a), n = parts(b);
  const auto at = [&](int i, int j) {
    Vector3 point = corner;
    for (std::size_t k = 0; k < 3; ++k) point[k] += a[k] * i / m + b[k] * j / n;
    return point;
  };
  const auto triangle = [&](const Vector3& p, const Vector3& q, const Vector3& r) {
    file << "facet normal 0 0 0\nouter loop\n";
    for (const auto& v : {p, q, r}) file << "vertex " << v[0] << ' ' << v[1] << ' ' << v[2] << '\n';
    file << "endloop\nendfacet\n";
  };
  for (int i = 0; i < m; ++i)
    for (int j = 0; j < n; ++j) {
      triangle(at(i, j), at(i + 1, j), at(i + 1, j + 1));
      triangle(at(i, j), at(i + 1, j + 1), at(i, j + 1));
    }
}

struct Discharge {
  double rate = 0;          ///< kg/s, until less than half of the bed is left
  double bulk_density = 0;  ///< kg/m3, of the bed before
};

/// Grains poured onto the closed bottom, settled, then let out through a slot of a width across the whole depth: the
/// grains above the slot are held by a shutter of wall triangles, which the second engine, with the same grains, does
/// not have.  What has fallen is taken out.
Discharge discharge(double slot) {
  Campaign campaign = one_species(d, density);
  campaign.scene.geometry.depth = depth;
  campaign.scene.geometry.sides = Geometry::Sides::periodic;
  campaign.scene.geometry.profile = {{0, half_width}, {40 * d, half_width}};
  campaign.charging.hopper_height = 0;
  campaign.contacts.youngs_modulus = campaign.contacts.wall_youngs_modulus = 1e7;
  for (auto& [name, pair] : campaign.contacts.pairs) pair = {0.5, 0.5, 0};
  const double step = 0.1 * dem_time_step(campaign).reference;
  const auto make = [&](bool shutter) {
    const auto file = test_folder() / (shutter ? "closed.stl" : "open.stl");
    std::ofstream stream(file);
    stream << "solid hopper\n";
    for (const double side : {-1.0, 1.0}) {
      write_rectangle(stream, {side * half_width, -depth / 2, 0}, {0, depth, 0}, {0, 0, 40 * d});
      write_rectangle(stream, {side * slot / 2, -depth / 2, floor_height}, {side * (half_width - slot / 2), 0, 0},
                      {0, depth, 0});
    }
    if (shutter) write_rectangle(stream, {-slot / 2, -depth / 2, floor_height}, {slot, 0, 0}, {0, depth, 0});
    stream << "endsolid hopper\n";
    stream.close();
    return make_liggghts_engine(campaign, {file.string(), test_folder().string(), step, {}}, MPI_COMM_WORLD);
  };
  std::vector<Parcel> parcels = poured(campaign, 40 * d);
  std::erase_if(parcels, [](const Parcel& p) { return p.position[2] < floor_height + 0.6 * d; });
  {
    auto closed = make(true);
    closed->add(parcels);
    advance_until(*closed, std::lround(0.05 / step), [](const std::vector<Parcel>& all) {
      double speed = 0;
      for (const auto& parcel : all) speed += std::abs(parcel.velocity[2]) / static_cast<double>(all.size());
      return speed < 0.005;
    });
    parcels = everyone(*closed);
  }
  Discharge result;
  result.bulk_density = density * packing_fraction(campaign, parcels, {-4 * d, -depth / 2, floor_height + 2 * d},
                                                   {4 * d, depth / 2, floor_height + 8 * d});
  for (auto& parcel : parcels) parcel.displacement = {};
  auto open = make(false);
  open->add(parcels);
  const double mass = parcels[0].mass;
  const double block = 0.02;
  std::size_t at_begin = 0;
  double begun = 0, time = 0;
  std::size_t inside = parcels.size();
  for (int blocks = 0; blocks < 300; ++blocks) {
    open->advance(std::lround(block / step));
    time += static_cast<double>(std::lround(block / step)) * step;
    std::vector<std::int64_t> fallen;
    for (const auto& parcel : everyone(*open))
      if (parcel.position[2] < 2 * d) fallen.push_back(parcel.id);
    if (!fallen.empty()) open->remove(fallen);
    inside = 0;
    for (const auto& parcel : everyone(*open)) inside += parcel.position[2] > floor_height ? 1 : 0;
    // Steady from when the first grains have fallen until less than half of the bed is left.
    if (time > 0.15 && at_begin == 0) {
      at_begin = inside;
      begun = time;
    }
    if (at_begin > 0 && inside > parcels.size() * 45 / 100)
      result.rate = static_cast<double>(at_begin - inside) * mass / (time - begun);
    else if (at_begin > 0)
      return result;
  }
  return result;
}

/// Beverloo's law for a slot, by unit of its length: 1.03 rho_b sqrt(g) (D - 1.4 d)^1.5 (Nedderman 1992, from Myers
/// and Sellers).
double beverloo_slot(double bulk_density, double slot) {
  return 1.03 * bulk_density * std::sqrt(9.81) * std::pow(slot - 1.4 * d, 1.5) * depth;
}

TEST(Hopper, DischargesByBeverloosLaw) {
  const Discharge narrow = discharge(4 * d);
  const Discharge wide = discharge(6 * d);
  const double of_narrow = narrow.rate / beverloo_slot(narrow.bulk_density, 4 * d);
  const double of_wide = wide.rate / beverloo_slot(wide.bulk_density, 6 * d);
  std::printf("rate over Beverloo's: %.3f and %.3f, bulk density %.0f\n", of_narrow, of_wide, wide.bulk_density);
  EXPECT_NEAR(of_narrow, 1, 0.2);
  EXPECT_NEAR(of_wide, 1, 0.2);
  EXPECT_NEAR(of_wide / of_narrow, 1, 0.08);
}

}  // namespace
}  // namespace cupola::test
