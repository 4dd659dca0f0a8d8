// Discharge of a flat-bottomed hopper through a slot.
#include <gtest/gtest.h>
#include <mpi.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <numbers>

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

/// Side walls of the whole height, a flat bottom from `from` to `to` and no more.
std::unique_ptr<Engine> hopper(const Campaign& campaign, double step, const std::string& name,
                               const std::vector<std::array<double, 2>>& bottoms) {
  const double wide = campaign.scene.geometry.profile[0][1];
  const auto file = test_folder() / (name + ".stl");
  std::ofstream stream(file);
  stream << "solid hopper\n";
  for (const double side : {-1.0, 1.0})
    write_rectangle(stream, {side * wide, -depth / 2, 0}, {0, depth, 0}, {0, 0, 40 * d});
  for (const auto& [from, to] : bottoms)
    write_rectangle(stream, {from, -depth / 2, floor_height}, {to - from, 0, 0}, {0, depth, 0});
  stream << "endsolid hopper\n";
  stream.close();
  return make_liggghts_engine(campaign, {file.string(), test_folder().string(), step, {}}, MPI_COMM_WORLD);
}

Campaign hopper_campaign(double half_width_of_it) {
  Campaign campaign = one_species(d, density);
  campaign.scene.geometry.depth = depth;
  campaign.scene.geometry.sides = Geometry::Sides::periodic;
  campaign.scene.geometry.profile = {{0, half_width_of_it}, {40 * d, half_width_of_it}};
  campaign.charging.hopper_height = 0;
  campaign.contacts.youngs_modulus = campaign.contacts.wall_youngs_modulus = 1e7;
  return campaign;
}

/// Grains poured onto a closed bottom, at rest.
std::vector<Parcel> settled(const Campaign& campaign, double step, double filled_to) {
  const double wide = campaign.scene.geometry.profile[0][1];
  std::vector<Parcel> parcels = poured(campaign, filled_to);
  std::erase_if(parcels, [](const Parcel& p) { return p.position[2] < floor_height + 0.6 * d; });
  auto closed = hopper(campaign, step, "closed", {{-wide, wide}});
  closed->add(parcels);
  advance_until(*closed, std::lround(0.05 / step), [](const std::vector<Parcel>& all) {
    double speed = 0;
    for (const auto& parcel : all) speed += std::abs(parcel.velocity[2]) / static_cast<double>(all.size());
    return speed < 0.005;
  });
  parcels = everyone(*closed);
  for (auto& parcel : parcels) parcel.displacement = {};
  return parcels;
}

struct Discharge {
  double rate = 0;          ///< kg/s, until less than half of the bed is left
  double bulk_density = 0;  ///< kg/m3, of the bed before
};

/// Grains let out of the bed through a slot of a width across the whole depth, by a second engine whose bottom has it.
/// What has fallen is taken out.
Discharge discharge(double slot) {
  Campaign campaign = hopper_campaign(half_width);
  for (auto& [name, pair] : campaign.contacts.pairs) pair = {0.5, 0.5, 0};
  const double step = 0.1 * dem_time_step(campaign).reference;
  const std::vector<Parcel> parcels = settled(campaign, step, 40 * d);
  Discharge result;
  result.bulk_density = density * packing_fraction(campaign, parcels, {-4 * d, -depth / 2, floor_height + 2 * d},
                                                   {4 * d, depth / 2, floor_height + 8 * d});
  auto open = hopper(campaign, step, "open", {{-half_width, -slot / 2}, {slot / 2, half_width}});
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
  // A thousand grains scatter by two or three per cent, and the bed is weighed at rest, denser than it flows.
  EXPECT_NEAR(of_narrow, 1, 0.25);
  EXPECT_NEAR(of_wide, 1, 0.25);
  EXPECT_NEAR(of_wide / of_narrow, 1, 0.08);
}

/// Angle of the slope that stays when the bottom beside the right wall is taken away, degrees.
double angle_of_repose(double friction, Contacts::Rolling rolling_model, double rolling) {
  constexpr double wide = 9 * d, edge = 4 * d;  // the slope runs from the left wall, at -wide, down to the edge
  Campaign campaign = hopper_campaign(wide);
  campaign.contacts.rolling_model = rolling_model;
  for (auto& [name, pair] : campaign.contacts.pairs) pair = {0.5, friction, rolling};
  const double step = 0.1 * dem_time_step(campaign).reference;
  const auto parcels = settled(campaign, step, floor_height + 13 * d);
  auto open = hopper(campaign, step, "open", {{-wide, edge}});
  open->add(parcels);
  for (double time = 0; time < 1.5; time += 0.05) {
    open->advance(std::lround(0.05 / step));
    std::vector<std::int64_t> fallen;
    for (const auto& parcel : everyone(*open))
      if (parcel.position[2] < floor_height - d) fallen.push_back(parcel.id);
    if (!fallen.empty()) open->remove(fallen);
  }
  // The slope's foot is at the edge: a triangle of the area A and the width w has the angle atan(2 A/w^2).
  double volume = 0;
  const auto staying = everyone(*open);
  for (const auto& parcel : staying) volume += parcel.mass / density;
  const double fraction = packing_fraction(campaign, staying, {-wide + d, -depth / 2, floor_height + 0.5 * d},
                                           {-wide + 4 * d, depth / 2, floor_height + 2.5 * d});
  const double width = wide + edge;
  return std::atan(2 * volume / fraction / depth / (width * width)) * 180 / std::numbers::pi;
}

TEST(AngleOfRepose, RisesWithFriction) {
  const double slippery = angle_of_repose(0.1, Contacts::Rolling::none, 0);
  const double middling = angle_of_repose(0.3, Contacts::Rolling::none, 0);
  const double rough = angle_of_repose(0.9, Contacts::Rolling::none, 0);
  const double stiff = angle_of_repose(0.9, Contacts::Rolling::epsd, 0.3);
  std::printf("angle of repose: %.1f, %.1f, %.1f degrees at friction 0.1, 0.3, 0.9; %.1f with rolling friction 0.3\n",
              slippery, middling, rough, stiff);
  EXPECT_GT(slippery, 5);
  EXPECT_GT(middling, slippery + 1);
  EXPECT_GT(rough, middling + 1);
  EXPECT_GT(stiff, rough + 3);
  EXPECT_LT(stiff, 45);
}

}  // namespace
}  // namespace cupola::test
