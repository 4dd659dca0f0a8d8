// Discharge through a circular orifice against Beverloo's law; angle of repose against friction.
#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <numbers>
#include <vector>

#include "stage_dem/liggghts_engine.hpp"
#include "tests/verification/dem/proof_scene.hpp"

namespace cupola::test {
namespace {

void write_triangle(std::ofstream& file, const Vector3& a, const Vector3& b, const Vector3& c) {
  file << "facet normal 0 0 0\nouter loop\n";
  for (const auto& v : {a, b, c}) file << "vertex " << v[0] << ' ' << v[1] << ' ' << v[2] << '\n';
  file << "endloop\nendfacet\n";
}

void write_quad(std::ofstream& file, const Vector3& a, const Vector3& b, const Vector3& c, const Vector3& d) {
  write_triangle(file, a, b, c);
  write_triangle(file, a, c, d);
}

/// A bin of square plan, 2 w wide, with a flat floor at z = 0 that has a round hole in its middle.
void write_bin(const std::filesystem::path& path, double w, double height, double orifice) {
  std::ofstream file(path);
  file << "solid bin\n";
  constexpr int levels = 4;
  for (int level = 0; level < levels; ++level) {
    const double low = height * level / levels, high = height * (level + 1) / levels;
    const std::array<std::array<double, 2>, 5> corner{{{-w, -w}, {w, -w}, {w, w}, {-w, w}, {-w, -w}}};
    for (std::size_t i = 0; i < 4; ++i)
      write_quad(file, {corner[i][0], corner[i][1], low}, {corner[i + 1][0], corner[i + 1][1], low},
                 {corner[i + 1][0], corner[i + 1][1], high}, {corner[i][0], corner[i][1], high});
  }
  constexpr int sides = 32;
  const auto edge = [&](int i, bool hole) {
    const double angle = 2 * std::numbers::pi * (i + 0.5) / sides;
    const double radius = hole ? orifice / 2 : w / std::max(std::abs(std::cos(angle)), std::abs(std::sin(angle)));
    return Vector3{radius * std::cos(angle), radius * std::sin(angle), 0};
  };
  for (int i = 0; i < sides; ++i) {
    write_quad(file, edge(i, true), edge(i + 1, true), edge(i + 1, false), edge(i, false));
    // The corner between two outer points that lie on different sides.
    const auto a = edge(i, false), b = edge(i + 1, false);
    if (std::abs(std::abs(a[0]) - w) < 1e-9 * w && std::abs(std::abs(b[1]) - w) < 1e-9 * w)
      write_triangle(file, a, {a[0], b[1], 0}, b);
    if (std::abs(std::abs(a[1]) - w) < 1e-9 * w && std::abs(std::abs(b[0]) - w) < 1e-9 * w)
      write_triangle(file, a, {b[0], a[1], 0}, b);
  }
  file << "endsolid bin\n";
}

TEST(Hopper, DischargesAsBeverlooSays) {
  // W = 0.58 rho_b sqrt(g) (D - 1.4 d)^2.5 with D = 6 d, bin 12 d wide: some 1,300 grains, a third of which run out.
  constexpr double d = 0.02;
  constexpr double orifice = 6 * d;
  Campaign campaign = one_species(d, 2500);
  campaign.contacts.wall_youngs_modulus = campaign.contacts.youngs_modulus = 5e6;
  for (auto& [name, pair] : campaign.contacts.pairs) pair = {0.5, 0.5, 0};
  campaign.scene.geometry.profile = {{-0.3, 6.5 * d}, {0.7, 6.5 * d}};
  campaign.scene.geometry.depth = 13 * d;
  const auto folder = test_folder();
  write_bin(folder / "bin.stl", 6 * d, 1, orifice);
  const double step = 0.1 * dem_time_step(campaign).reference;
  auto engine =
      make_liggghts_engine(campaign, {(folder / "bin.stl").string(), folder.string(), step, {}}, MPI_COMM_WORLD);
  std::vector<Parcel> grains;
  for (int layer = 0; layer < 12; ++layer)
    for (double x = -5.4 * d; x < 5.5 * d; x += 1.08 * d)
      for (double y = -5.4 * d; y < 5.5 * d; y += 1.08 * d) {
        const double wobble = 0.02 * d * std::sin(12.9898 * static_cast<double>(grains.size()));
        grains.push_back(new_parcel(campaign, static_cast<std::int64_t>(grains.size()) + 1, 0,
                                    {x + wobble, y - wobble, (0.55 + 1.03 * layer) * d}, {}));
      }
  engine->add(grains);
  double bulk = 0, mass = 0, since = -1, time = 0;
  std::int64_t out_before = 0;
  while (time < 3) {
    engine->advance(std::lround(0.01 / step));
    time = static_cast<double>(engine->step()) * step;
    const auto all = everyone(*engine);
    std::vector<std::int64_t> gone;
    for (const auto& grain : all)
      if (grain.position[2] < -0.1) gone.push_back(grain.id);
    engine->remove(gone);
    mass += static_cast<double>(gone.size()) * grains[0].mass;
    const auto left = static_cast<double>(all.size());
    const double share = 1 - left / static_cast<double>(grains.size());
    if (since < 0 && share > 0.08) {  // steady flow from here, past the loose start
      since = time;
      out_before = static_cast<std::int64_t>(std::lround(mass / grains[0].mass));
      bulk = 2500 * packing_fraction(campaign, all, {-4 * d, -4 * d, 1.5 * d}, {4 * d, 4 * d, 6 * d});
    }
    if (share > 0.35) break;
  }
  ASSERT_GT(since, 0);
  const double rate = (mass - static_cast<double>(out_before) * grains[0].mass) / (time - since);
  const double beverloo = 0.58 * bulk * std::sqrt(9.81) * std::pow(orifice - 1.4 * d, 2.5);
  RecordProperty("rate_over_beverloo", std::to_string(rate / beverloo));
  EXPECT_NEAR(rate / beverloo, 1, 0.15);
}

/// Slope of the heap that a column of grains collapses to, degrees: a straight line through the mean heights of the
/// heap's flanks.
double angle_of_repose(double friction, double rolling) {
  constexpr double d = 0.02;
  Campaign campaign = one_species(d, 2500);
  campaign.contacts.wall_youngs_modulus = campaign.contacts.youngs_modulus = 5e6;
  campaign.contacts.rolling_model = Contacts::Rolling::epsd2;
  for (auto& [name, pair] : campaign.contacts.pairs) pair = {0.3, friction, rolling};
  campaign.contacts.pairs["coke-wall"] = {0.3, 0.9, 0.3};
  campaign.scene.geometry.sides = Geometry::Sides::periodic;
  campaign.scene.geometry.depth = 4 * d;
  campaign.scene.geometry.profile = {{0, 26 * d}, {20 * d, 26 * d}};
  const double step = 0.1 * dem_time_step(campaign).reference;
  auto engine = box_engine(campaign, step);
  std::vector<Parcel> grains;
  for (int layer = 0; layer < 14; ++layer)
    for (double x = -4.2 * d; x < 4.3 * d; x += 1.05 * d)
      for (double y = -1.5 * d; y < 2 * d; y += 1.33 * d) {
        const double wobble = 0.1 * d * std::sin(12.9898 * static_cast<double>(grains.size()));
        grains.push_back(new_parcel(campaign, static_cast<std::int64_t>(grains.size()) + 1, 0,
                                    {x + wobble / 5, y + wobble, (0.55 + 1.02 * layer) * d}, {}));
      }
  engine->add(grains);
  engine->advance(std::lround(1.2 / step));
  // Surface: highest grain of each strip of 2 d, left and right folded together.
  std::vector<double> height(13, 0.0);
  for (const auto& grain : everyone(*engine)) {
    const auto strip = static_cast<std::size_t>(std::abs(grain.position[0]) / (2 * d));
    if (strip < height.size()) height[strip] = std::max(height[strip], grain.position[2] + d / 2);
  }
  double sx = 0, sz = 0, sxx = 0, sxz = 0, n = 0;
  for (std::size_t strip = 0; strip < height.size(); ++strip) {
    if (height[strip] < 1.8 * d) break;  // the thin skirt
    const double x = (2 * static_cast<double>(strip) + 1) * d;
    sx += x, sz += height[strip], sxx += x * x, sxz += x * height[strip], n += 1;
  }
  return n < 3 ? 0 : std::atan(-(n * sxz - sx * sz) / (n * sxx - sx * sx)) * 180 / std::numbers::pi;
}

TEST(Repose, AngleRisesWithFriction) {
  const double smooth = angle_of_repose(0.1, 0.02), usual = angle_of_repose(0.4, 0.1),
               rough = angle_of_repose(0.9, 0.4);
  RecordProperty("angles", std::to_string(smooth) + " " + std::to_string(usual) + " " + std::to_string(rough));
  EXPECT_GT(usual, smooth + 2);
  EXPECT_GT(rough, usual + 2);
  EXPECT_GT(usual, 12);
  EXPECT_LT(rough, 50);
}

}  // namespace
}  // namespace cupola::test
