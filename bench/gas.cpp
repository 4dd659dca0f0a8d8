// Processor seconds of the first rank by part of the gas and of the projection, cold and warm, on the meshes of the two
// furnaces.
//   bench_gas prepare quick|paper RANKS FOLDER
//   bench_gas run quick|paper FOLDER             (with mpirun -n RANKS where prepared for more than one)
#include <fmt/format.h>
#include <time.h>

#include <cmath>
#include <cstdlib>
#include <functional>
#include <random>
#include <string>

#include "physics/gas/bed_gas.hpp"
#include "physics/mesh/cell_locator.hpp"
#include "physics/projection/cell_spreading.hpp"
#include "physics/projection/cell_sums.hpp"
#include "physics/projection/clean_field.hpp"
#include "tests/support/foam_scene.hpp"
#include "tests/support/furnaces.hpp"

namespace cupola {
namespace {

/// Processor time of this process: wall time says little on a busy machine.
double seconds(const std::function<void()>& work) {
  const auto now = [] {
    timespec time{};
    clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &time);
    return static_cast<double>(time.tv_sec) + 1e-9 * static_cast<double>(time.tv_nsec);
  };
  const double begin = now();
  work();
  return now() - begin;
}

/// Layers of coke and ore, raceways, and the freeboard where there is one.
struct Bed {
  Bed(const BedMesh& mesh, const Campaign& campaign) : state(uniform_bed(mesh, 0.42, 0.044)) {
    for (std::size_t cell = 0; cell < mesh.cells(); ++cell) {
      const Vector3& c = mesh.cell_centre[cell];
      const double half_width = campaign.half_width(c[2]);
      if (c[2] > 3 && std::fmod(c[2], 0.8) < 0.4) {
        state.grain_diameter[cell] = 0.015;
        state.void_fraction[cell] = 0.4;
      }
      const bool raceway = std::abs(c[2] - 0.06) < 0.4 && std::abs(c[0]) > half_width - 1;
      if (raceway) state.void_fraction[cell] = 0.75;
      const bool freeboard = c[2] > campaign.charging.stock_line;
      if (freeboard) state.void_fraction[cell] = 1;
      temperature.push_back(400 + 1800 / (1 + std::exp(c[2] + std::abs(c[0]) - 3)));
      const double conductance = freeboard ? 0 : 500 * mesh.cell_volume[cell];
      exchange.conductance.push_back(conductance);
      exchange.conductance_temperature.push_back(conductance * (temperature.back() - 50));
      raw.bed.push_back(!freeboard);
      raw.sink.push_back(raceway ? 1e-3 : 0);
      raw.coke_flux.push_back(
          {1e-4 * std::sin(40 * c[0] + 30 * c[2]), 0, -1e-3 * (1 + 0.3 * std::sin(50 * c[1] + 20 * c[2]))});
    }
    raw.smoothing_passes = 4;
  }
  BedState state;
  SolidsExchange exchange;
  RawGranularField raw;
  std::vector<double> temperature;
};

void bench_parcels(const BedMesh& mesh, const Campaign& campaign) {
  const CellLocator locator(mesh);
  std::mt19937_64 generator(1);
  std::uniform_int_distribution<std::size_t> any_cell(0, mesh.cells() - 1);
  std::vector<Vector3> centres;
  std::vector<std::int64_t> guesses;
  for (int i = 0; i < 100000; ++i) {
    const auto cell = any_cell(generator);
    std::uniform_real_distribution<double> part(-0.4, 0.4);
    const double size = std::cbrt(mesh.cell_volume[cell]);
    Vector3 centre = mesh.cell_centre[cell];
    for (double& x : centre) x += size * part(generator);
    centres.push_back(centre);
    guesses.push_back(static_cast<std::int64_t>(cell));
  }
  std::vector<CellShare> shares;
  std::size_t count = 0;
  const double radius = campaign.species[0].parcel_diameter() / 2;
  const double whole = seconds([&] {
    for (std::size_t i = 0; i < centres.size(); ++i)
      count += divide_parcel(locator, centres[i], radius, guesses[i], shares);
  });
  fmt::print("divide a parcel          {:8.3f} us, {:.1f} cells each\n",
             1e6 * whole / static_cast<double>(centres.size()),
             static_cast<double>(count) / static_cast<double>(centres.size()));
}

void run(const Campaign& campaign, const std::filesystem::path& folder, int& argc, char**& argv) {
  FoamCase foam(folder / "foam", argc, argv);
  const BedMesh mesh = BedMesh::read(folder / "foam" / "mesh.hdf");
  const auto say = [&](const std::string& text) {
    if (foam.rank() == 0) fmt::print("{}\n", text);
  };
  say(fmt::format("{}: {} cells, {} ranks", campaign.name, mesh.cells(), foam.ranks()));
  Bed bed(mesh, campaign);
  DarcyForchheimer flow(foam, mesh, campaign);
  GasEnergy energy(foam, mesh, campaign);
  DarcyForchheimer::Result result;
  const auto solve_flow = [&](const std::string& name, double tolerance, int iterations) {
    const double time = seconds([&] { result = flow.solve(bed.state, bed.temperature, tolerance, iterations); });
    say(fmt::format("{:24} {:8.3f} s, {} iterations, {} cycles, change {:.1e}, mass residual {:.1e}", name, time,
                    result.iterations, result.cycles, result.change, result.mass_residual));
  };
  solve_flow("flow, cold to 1e-4", 1e-4, 50);
  solve_flow("flow, on to 1e-8", 1e-8, 50);
  for (double& t : bed.temperature) t *= 1 + 0.02 * std::sin(t);
  solve_flow("flow, warm, one", 1e-8, 1);
  const double cold = seconds([&] { energy.solve(flow, bed.state, bed.exchange); });
  say(fmt::format("energy, cold             {:8.3f} s, balance closes to {:.1e}", cold, energy.ledger().residual));
  for (double& value : bed.exchange.conductance_temperature) value *= 1.01;
  const double warm = seconds([&] { energy.solve(flow, bed.state, bed.exchange); });
  say(fmt::format("energy, warm             {:8.3f} s, balance closes to {:.1e}", warm, energy.ledger().residual));
  CleanGranularField clean;
  const double cleaning = seconds([&] { clean = clean_granular_field(foam, mesh, bed.raw); });
  say(fmt::format("clean a granular field   {:8.3f} s, error {:.1e} to {:.1e}", cleaning, clean.error_before,
                  clean.error_after));
  const CellSpreading spreading(mesh, bed.raw.bed, campaign.species[0].parcel_diameter());
  const double spread = seconds([&] { spreading.apply(bed.temperature); });
  say(fmt::format("spread a field           {:8.4f} s, {} passes", spread, spreading.passes()));
  if (foam.rank() == 0) bench_parcels(mesh, campaign);
}

int main_program(int argc, char** argv) {
  const std::string what = argc > 2 ? argv[1] : "";
  if (!(what == "prepare" && argc == 5) && !(what == "run" && argc == 4)) {
    fmt::print(stderr, "bench_gas prepare quick|paper RANKS FOLDER, then bench_gas run quick|paper FOLDER\n");
    return 65;
  }
  Campaign campaign = std::string(argv[2]) == "paper" ? furnaces::paper() : furnaces::shaft();
  if (campaign.name == "paper") {
    for (auto& inlet : campaign.scene.gas->inlets) inlet.mass_flow = 8.6;
  }
  campaign.scene.heat_loss = WallHeatLoss{20, 293};
  if (what == "run") {
    run(campaign, argv[3], argc, argv);
    return 0;
  }
  campaign.launch.ranks = std::atoi(argv[3]);
  std::filesystem::create_directories(argv[4]);
  prepare(argv[4], task_of(campaign));
  return 0;
}

}  // namespace
}  // namespace cupola

int main(int argc, char** argv) {
  try {
    return cupola::main_program(argc, argv);
  } catch (const std::exception& error) {
    fmt::print(stderr, "{}\n", error.what());
    return 70;
  }
}
