#include "bench/dem_bed.hpp"

#include <mpi.h>

#include <cmath>

#include "physics/mesh/prepare.hpp"
#include "physics/plan/dem_time_step.hpp"
#include "stage_dem/liggghts_engine.hpp"
#include "stage_dem/parcels.hpp"
#include "stage_dem/pouring.hpp"

namespace cupola::bench {
namespace {

constexpr double diameter = 0.176;  // m, of a parcel
constexpr double tile_depth = 15 * diameter;
constexpr std::size_t parcels_a_tile = 5000;

}  // namespace

Campaign dem_bed(int tiles) {
  Campaign campaign;
  campaign.name = "bench";
  campaign.scene.geometry.kind = Geometry::Kind::box;
  campaign.scene.geometry.depth = tiles * tile_depth;
  campaign.scene.geometry.profile = {{0, 8 * diameter}, {22 * diameter, 8 * diameter}};
  campaign.scene.mesh.cell = diameter;
  campaign.scene.mesh.cells = MeshCells{8, 15 * tiles, {22}};
  campaign.charging.stock_line = 22 * diameter;
  campaign.charging.hopper_height = 30 * diameter;  // it is poured from there
  Species coke;
  coke.name = "coke";
  coke.diameter = diameter / 4;
  coke.coarse_graining = 4;
  coke.density = 800;
  campaign.species = {coke};
  campaign.contacts.pairs = {{"coke-coke", {0.5, 0.9, 0.5}}, {"coke-wall", {0.5, 0.5, 0.02}}};
  Gas gas;
  gas.species = "air";
  gas.molar_mass = 0.029;
  gas.heat_capacity = 1005;
  gas.viscosity = 1.8e-5;
  gas.prandtl = 0.7;
  Inlet blast;
  blast.name = "blast";
  blast.side = Inlet::Side::bottom;
  blast.mass_flow = 1.2 * 16 * diameter * campaign.scene.geometry.depth;  // 1 m/s
  gas.inlets = {blast};
  campaign.scene.gas = gas;
  campaign.descent_rate = 1e-3;
  return campaign;
}

std::vector<Parcel> settled_tile(const std::filesystem::path& folder) {
  const Campaign campaign = dem_bed(1);
  Task task;
  task.campaign = campaign;
  prepare(folder, task);
  Pouring pouring(campaign, {});
  RandomNumbers random(7, RandomNumbers::Use::building, 0);
  std::int64_t id = 1;
  while (pouring.placed().size() < parcels_a_tile &&
         pouring.place(
             campaign.bottom() + diameter / 2, campaign.hopper_top() - diameter, id, [](double) { return 0; }, random,
             1000))
    ++id;
  const double step = 0.2 * dem_time_step(campaign).reference;
  auto engine = make_liggghts_engine(campaign, {(folder / "foam" / "wall.stl").string(), folder.string(), step, {}},
                                     MPI_COMM_WORLD);
  engine->add(pouring.placed());
  engine->advance(std::lround(2.0 / step));
  engine->exchange();
  return gather_parcels(*engine, MPI_COMM_WORLD);
}

std::vector<Parcel> tiled(const std::vector<Parcel>& tile, int tiles) {
  std::vector<Parcel> all;
  for (int place = 0; place < tiles; ++place)
    for (Parcel parcel : tile) {
      parcel.id += static_cast<std::int64_t>(place * tile.size());
      parcel.position[1] += (place - (tiles - 1) / 2.0) * tile_depth;
      parcel.displacement = {};
      all.push_back(parcel);
    }
  return all;
}

}  // namespace cupola::bench
