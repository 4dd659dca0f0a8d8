// Processor seconds of the first rank by part of the gas and of the projection, cold and warm, on the meshes of the two
// furnaces.
//   bench_gas [--json FILE]                      both, on one rank
//   bench_gas prepare shaft|paper RANKS FOLDER
//   bench_gas run shaft|paper FOLDER             with mpirun -n RANKS where prepared for more than one
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

/// What was measured: printed as a table and kept for the list of all benchmarks (tools/run_benchmarks.sh).
class Measurements {
 public:
  Measurements(std::string setting, int ranks, std::size_t cells, bool speaks)
      : setting_(std::move(setting)), ranks_(ranks), cells_(cells), speaks_(speaks) {
    if (speaks_) fmt::print("{}: {} cells, {} ranks\n", setting_, cells_, ranks_);
  }
  void add(const std::string& metric, double value, const std::string& unit, const std::string& remark = "") {
    if (speaks_) fmt::print("{:26}{:10.4f} {}  {}\n", metric, value, unit, remark);
    list.push_back({{"bench", "gas"},
                    {"setting", setting_},
                    {"metric", metric},
                    {"value", value},
                    {"unit", unit},
                    {"ranks", ranks_},
                    {"cells", cells_},
                    {"parcels", 0}});
  }
  nlohmann::json list = nlohmann::json::array();

 private:
  std::string setting_;
  int ranks_;
  std::size_t cells_;
  bool speaks_;
};

/// Microseconds to divide a parcel among cells, guesses right.
double parcel_microseconds(const BedMesh& mesh, const Campaign& campaign) {
  const CellLocator locator(mesh);
  std::mt19937_64 generator(1);
  std::uniform_int_distribution<std::size_t> any_cell(0, mesh.cells() - 1);
  std::uniform_real_distribution<double> part(-0.4, 0.4);
  std::vector<Vector3> centres;
  std::vector<std::int64_t> guesses;
  for (int i = 0; i < 100000; ++i) {
    const auto cell = any_cell(generator);
    Vector3 centre = mesh.cell_centre[cell];
    for (double& x : centre) x += std::cbrt(mesh.cell_volume[cell]) * part(generator);
    centres.push_back(centre);
    guesses.push_back(static_cast<std::int64_t>(cell));
  }
  std::vector<CellShare> shares;
  const double radius = campaign.species[0].parcel_diameter() / 2;
  const double whole = seconds([&] {
    for (std::size_t i = 0; i < centres.size(); ++i) divide_parcel(locator, centres[i], radius, guesses[i], shares);
  });
  return 1e6 * whole / static_cast<double>(centres.size());
}

nlohmann::json run(const Campaign& campaign, const std::filesystem::path& folder, int& argc, char**& argv) {
  FoamCase foam(folder / "foam", argc, argv);
  const BedMesh mesh = BedMesh::read(folder / "foam" / "mesh.hdf");
  Measurements measured(campaign.name, foam.ranks(), mesh.cells(), foam.rank() == 0);
  Bed bed(mesh, campaign);
  DarcyForchheimer flow(foam, mesh, campaign);
  GasEnergy energy(foam, mesh, campaign);
  const auto solve_flow = [&](const std::string& name, double tolerance, int iterations) {
    DarcyForchheimer::Result result;
    const double time = seconds([&] { result = flow.solve(bed.state, bed.temperature, tolerance, iterations); });
    measured.add(name, time, "s",
                 fmt::format("{} iterations, {} cycles, change {:.1e}, mass residual {:.1e}", result.iterations,
                             result.cycles, result.change, result.mass_residual));
  };
  const auto solve_energy = [&](const std::string& name) {
    const double time = seconds([&] { energy.solve(flow, bed.state, bed.exchange); });
    measured.add(name, time, "s", fmt::format("balance closes to {:.1e}", energy.ledger().residual));
  };
  solve_flow("flow, cold to 1e-4", 1e-4, 50);
  solve_flow("flow, on to 1e-8", 1e-8, 50);
  for (double& t : bed.temperature) t *= 1 + 0.02 * std::sin(t);
  solve_flow("flow, one warm iteration", 1e-8, 1);
  solve_energy("energy, cold");
  for (double& value : bed.exchange.conductance_temperature) value *= 1.01;
  solve_energy("energy, warm");
  CleanGranularField clean;
  const double cleaning = seconds([&] { clean = clean_granular_field(foam, mesh, bed.raw); });
  measured.add("clean a granular field", cleaning, "s",
               fmt::format("error {:.1e} to {:.1e}", clean.error_before, clean.error_after));
  const CellSpreading spreading(mesh, bed.raw.bed, campaign.species[0].parcel_diameter());
  const double spread = seconds([&] { spreading.apply(bed.temperature); });
  measured.add("spread a field", 1e3 * spread, "ms", fmt::format("{} passes", spreading.passes()));
  measured.add("divide a parcel", parcel_microseconds(mesh, campaign), "us");
  return measured.list;
}

Campaign campaign_of(const std::string& name) {
  Campaign campaign = name == "paper" ? furnaces::paper() : furnaces::shaft();
  if (name == "paper") {
    for (auto& inlet : campaign.scene.gas->inlets) inlet.mass_flow = 8.6;
  }
  campaign.scene.heat_loss = WallHeatLoss{20, 293};
  return campaign;
}

int main_program(int argc, char** argv) {
  const std::string what = argc > 1 ? argv[1] : "";
  if (what == "prepare" && argc == 5) {
    Campaign campaign = campaign_of(argv[2]);
    campaign.launch.ranks = std::atoi(argv[3]);
    std::filesystem::create_directories(argv[4]);
    prepare(argv[4], task_of(campaign));
  } else if (what == "run" && argc == 4) {
    run(campaign_of(argv[2]), argv[3], argc, argv);
  } else if (argc == 1 || (what == "--json" && argc == 3)) {
    auto all = nlohmann::json::array();
    for (const std::string name : {"shaft", "paper"}) {
      const TemporaryFolder folder;
      const Campaign campaign = campaign_of(name);
      prepare(folder.path(), task_of(campaign));
      for (auto& entry : run(campaign, folder.path(), argc, argv)) all.push_back(std::move(entry));
    }
    if (argc == 3) write_json_atomically(argv[2], all);
  } else {
    fmt::print(stderr, "bench_gas [--json FILE] | prepare shaft|paper RANKS FOLDER | run shaft|paper FOLDER\n");
    return 65;
  }
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
