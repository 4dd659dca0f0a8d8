#include "tests/unit/dem/box_scene.hpp"

#include <gtest/gtest.h>
#include <mpi.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <numbers>

#include "stage_dem/liggghts_engine.hpp"

namespace cupola::test {
namespace {

int my_rank() {
  int rank = 0;
  MPI_Comm_rank(MPI_COMM_WORLD, &rank);
  return rank;
}

/// A parallelogram corner + s a + t b as a grid of triangles.
void write_plane(std::ofstream& file, const Vector3& corner, const Vector3& a, const Vector3& b) {
  constexpr int n = 8;
  const auto at = [&](int i, int j) {
    Vector3 point{};
    for (std::size_t k = 0; k < 3; ++k) point[k] = corner[k] + a[k] * i / n + b[k] * j / n;
    return point;
  };
  const auto triangle = [&](const Vector3& p, const Vector3& q, const Vector3& r) {
    file << "facet normal 0 0 0\nouter loop\n";
    for (const auto& v : {p, q, r}) file << "vertex " << v[0] << ' ' << v[1] << ' ' << v[2] << '\n';
    file << "endloop\nendfacet\n";
  };
  for (int i = 0; i < n; ++i)
    for (int j = 0; j < n; ++j) {
      triangle(at(i, j), at(i + 1, j), at(i + 1, j + 1));
      triangle(at(i, j), at(i + 1, j + 1), at(i, j + 1));
    }
}

}  // namespace

Campaign box_campaign(double half_width, double depth, double height) {
  Campaign campaign;
  campaign.name = "box";
  campaign.scene.geometry.kind = Geometry::Kind::box;
  campaign.scene.geometry.depth = depth;
  campaign.scene.geometry.sides = Geometry::Sides::walls;
  campaign.scene.geometry.profile = {{0.0, half_width}, {height, half_width}};
  campaign.charging.hopper_height = 0.5;
  Species coke;
  coke.name = "coke";
  coke.diameter = 0.05;
  coke.coarse_graining = 2;
  coke.density = 800;
  Species ore;
  ore.name = "ore";
  ore.diameter = 0.02;
  ore.coarse_graining = 4;
  ore.density = 3000;
  campaign.species = {coke, ore};
  campaign.contacts.pairs = {{"coke-coke", {0.5, 0.9, 0.5}},
                             {"coke-ore", {0.2, 0.8, 0.02}},
                             {"ore-ore", {0.5, 0.8, 0.4}},
                             {"coke-wall", {0.5, 0.5, 0.02}},
                             {"ore-wall", {0.2, 0.2, 0.02}}};
  return campaign;
}

void write_box_walls(const Campaign& campaign, const std::filesystem::path& file) {
  const double w = campaign.scene.geometry.profile[0][1];
  const double d = campaign.scene.geometry.depth / 2;
  const double h = campaign.hopper_top();
  std::ofstream stream(file);
  stream << "solid walls\n";
  write_plane(stream, {-w, -d, 0}, {2 * w, 0, 0}, {0, 2 * d, 0});
  write_plane(stream, {-w, -d, 0}, {0, 0, h}, {0, 2 * d, 0});
  write_plane(stream, {w, -d, 0}, {0, 2 * d, 0}, {0, 0, h});
  if (campaign.scene.geometry.sides == Geometry::Sides::walls) {
    write_plane(stream, {-w, -d, 0}, {2 * w, 0, 0}, {0, 0, h});
    write_plane(stream, {-w, d, 0}, {0, 0, h}, {2 * w, 0, 0});
  }
  stream << "endsolid walls\n";
}

std::filesystem::path test_folder() {
  const auto* test = testing::UnitTest::GetInstance()->current_test_info();
  int ranks = 1;
  MPI_Comm_size(MPI_COMM_WORLD, &ranks);
  const std::filesystem::path folder =
      std::filesystem::temp_directory_path() / "cupola-tests" /
      (std::string(test->test_suite_name()) + "." + test->name() + "." + std::to_string(ranks));
  if (my_rank() == 0) std::filesystem::create_directories(folder);
  MPI_Barrier(MPI_COMM_WORLD);
  return folder;
}

Parcel make_parcel(const Campaign& campaign, std::int64_t id, int species, const Vector3& position,
                   const Vector3& velocity) {
  const Species& kind = campaign.species[static_cast<std::size_t>(species)];
  Parcel parcel;
  parcel.id = id;
  parcel.species = species;
  parcel.position = position;
  parcel.velocity = velocity;
  parcel.radius = kind.parcel_diameter() / 2;
  parcel.mass = kind.density * 4.0 / 3 * std::numbers::pi * std::pow(parcel.radius, 3);
  return parcel;
}

std::vector<Parcel> everyone(const Engine& engine) {
  const auto mine = engine.owned();
  int ranks = 1;
  MPI_Comm_size(MPI_COMM_WORLD, &ranks);
  std::vector<int> bytes(static_cast<std::size_t>(ranks));
  const int my_bytes = static_cast<int>(mine.size() * sizeof(Parcel));
  MPI_Allgather(&my_bytes, 1, MPI_INT, bytes.data(), 1, MPI_INT, MPI_COMM_WORLD);
  std::vector<int> offset(bytes.size(), 0);
  for (std::size_t r = 1; r < bytes.size(); ++r) offset[r] = offset[r - 1] + bytes[r - 1];
  std::vector<Parcel> all(static_cast<std::size_t>(offset.back() + bytes.back()) / sizeof(Parcel));
  MPI_Allgatherv(mine.data(), my_bytes, MPI_BYTE, all.data(), bytes.data(), offset.data(), MPI_BYTE, MPI_COMM_WORLD);
  std::sort(all.begin(), all.end(), [](const Parcel& a, const Parcel& b) { return a.id < b.id; });
  return all;
}

std::unique_ptr<Engine> box_engine(const Campaign& campaign, double time_step, const std::vector<std::uint8_t>& from) {
  const auto folder = test_folder();
  if (my_rank() == 0) write_box_walls(campaign, folder / "walls.stl");
  MPI_Barrier(MPI_COMM_WORLD);
  EngineSetUp set_up{(folder / "walls.stl").string(), folder.string(), time_step, from};
  return make_liggghts_engine(campaign, set_up, MPI_COMM_WORLD);
}

std::vector<Parcel> loose_parcels(const Campaign& campaign, int layers) {
  std::vector<Parcel> parcels;
  const double w = campaign.scene.geometry.profile[0][1];
  const double d = campaign.scene.geometry.depth / 2;
  constexpr double spacing = 0.11;
  for (int layer = 0; layer < layers; ++layer)
    for (double y = -d + 0.06; y < d - 0.055; y += spacing)
      for (double x = -w + 0.06; x < w - 0.055; x += spacing) {
        const auto id = static_cast<std::int64_t>(parcels.size()) + 1;
        // A deterministic wobble, so that the columns fall over.
        const double wobble = 0.002 * std::sin(12.9898 * static_cast<double>(id));
        parcels.push_back(
            make_parcel(campaign, id, static_cast<int>(id % 2), {x + wobble, y - wobble, 0.06 + spacing * layer}));
      }
  return parcels;
}

}  // namespace cupola::test
