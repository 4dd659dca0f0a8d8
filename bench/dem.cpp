// Cost of the DEM stage by its parts, at 5,000, 20,000 and 100,000 parcels on one and two ranks.
//   bench_dem [--json FILE]     every size on one and two ranks, each in a process of its own
//   bench_dem settle FOLDER     the bed that is tiled
//   bench_dem measure FOLDER --tiles N --out FILE    one size, on the ranks mpirun gives
// What a second of process time costs at the default settings (blocks of 0.05 s, steps of 5 % of the Rayleigh time, the
// quasi-steady gas solved every 0.25 s) is put together from what a step, a block and a solution cost: a hundred
// thousand parcels in blocks of full length would take hours.
#include <fmt/format.h>
#include <mpi.h>

#include <CLI/CLI.hpp>
#include <chrono>
#include <cstdlib>
#include <map>
#include <nlohmann/json.hpp>

#include "bench/dem_bed.hpp"
#include "physics/mesh/prepare.hpp"
#include "physics/plan/dem_time_step.hpp"
#include "schemas/failure.hpp"
#include "schemas/files.hpp"
#include "stage_dem/bed_sample.hpp"
#include "stage_dem/bed_watch.hpp"
#include "stage_dem/dem_gas.hpp"
#include "stage_dem/liggghts_engine.hpp"
#include "stage_dem/parcels.hpp"

namespace cupola::bench {
namespace {

using Json = nlohmann::json;

constexpr int warm_up = 20;
constexpr int coupling_steps = 200;
constexpr long short_block = 5, long_block = 105;  // steps
constexpr int long_blocks = 4;
constexpr int gas_solutions = 5;
constexpr double seconds_a_solution = 0.25;  // of process time, between two of the gas

/// Seconds of wall time by part, the slowest rank's.
class Clock {
 public:
  template <typename Work>
  void time(const std::string& part, Work&& work) {
    MPI_Barrier(MPI_COMM_WORLD);
    const double begun = MPI_Wtime();
    work();
    MPI_Barrier(MPI_COMM_WORLD);
    seconds_[part] += MPI_Wtime() - begun;
  }
  void forget() { seconds_.clear(); }
  [[nodiscard]] double of(const std::string& part) const { return seconds_.at(part); }

 private:
  std::map<std::string, double> seconds_;
};

std::vector<Parcel> read_tile(const std::filesystem::path& folder) {
  std::vector<Parcel> tile;
  for (const auto& row : read_json(folder / "tile.json"))
    tile.push_back(new_parcel(dem_bed(1), static_cast<std::int64_t>(tile.size()) + 1, 0, row.get<Vector3>()));
  return tile;
}

void settle(const std::filesystem::path& folder) {
  Json rows = Json::array();
  for (const auto& parcel : settled_tile(folder)) rows.push_back(parcel.position);
  write_json_atomically(folder / "tile.json", rows);
}

/// Seconds a step, a block and a solution take; what else the rows are made of.
Json measure(const std::filesystem::path& folder, int tiles, int argc, char** argv) {
  MPI_Init(&argc, &argv);
  int rank = 0, ranks = 1;
  MPI_Comm_rank(MPI_COMM_WORLD, &rank);
  MPI_Comm_size(MPI_COMM_WORLD, &ranks);
  Campaign campaign = dem_bed(tiles);
  campaign.launch.ranks = ranks;
  const auto scene = folder / fmt::format("{}_{}", tiles, ranks);
  if (rank == 0) {
    std::filesystem::create_directories(scene);
    Task task;
    task.campaign = campaign;
    prepare(scene, task);
  }
  MPI_Barrier(MPI_COMM_WORLD);
  FoamCase foam(scene / "foam", argc, argv);
  const BedMesh mesh = BedMesh::read(scene / "foam" / "mesh.hdf");
  const DemTimeStep step = dem_time_step(campaign);
  auto engine = make_liggghts_engine(campaign, {(scene / "foam" / "wall.stl").string(), scene.string(), step.step, {}},
                                     MPI_COMM_WORLD);
  engine->add(tiled(read_tile(folder), tiles));
  SolidsOnMesh solids(mesh, campaign, MPI_COMM_WORLD);
  WindowAverages averages(mesh.cells(), 0.01);
  auto gas = make_dem_gas(foam, mesh, campaign, std::vector<double>(mesh.cells(), 293), MPI_COMM_WORLD);
  Clock clock;
  for (int turn = 0; turn < warm_up + coupling_steps; ++turn) {
    if (turn == warm_up) clock.forget();
    const auto owned = engine->owned();
    clock.time("projection", [&] { solids.divide(owned); });
    clock.time("averaging", [&] {
      const double seconds = step.step * short_block;
      averages.add(sum_of(sample_bed(campaign, mesh, solids, owned, {}, seconds)), seconds);
    });
    clock.time("gas forces", [&] {
      gas->update(solids, owned, 0);
      engine->set_forces(gas->forces(solids, owned));
    });
    clock.time("short block", [&] { engine->advance(short_block); });
    clock.time("between blocks", [&] {
      const auto all = gather_parcels(*engine, MPI_COMM_WORLD);
      largest_overlap(campaign, all, MPI_COMM_WORLD);
      largest_wall_overlap(campaign, all);
      engine->exchange();
    });
  }
  for (int block = 0; block < long_blocks; ++block) clock.time("long block", [&] { engine->advance(long_block); });
  for (int turn = 0; turn < gas_solutions; ++turn) {
    const auto owned = engine->owned();
    solids.divide(owned);
    clock.time("gas solution", [&] { gas->update(solids, owned, 0, true); });
    engine->advance(short_block);
  }
  const double a_step =
      (clock.of("long block") / long_blocks - clock.of("short block") / coupling_steps) / (long_block - short_block);
  Json parts;
  for (const char* part : {"projection", "averaging", "gas forces", "between blocks"})
    parts[part] = clock.of(part) / coupling_steps / campaign.dem.block;
  parts["LIGGGHTS set-up"] =
      (clock.of("short block") / coupling_steps - static_cast<double>(short_block) * a_step) / campaign.dem.block;
  parts["gas solution"] = clock.of("gas solution") / gas_solutions / seconds_a_solution;
  const auto parcels = engine->count();
  const Json result{{"ranks", ranks},
                    {"cells", mesh.cells()},
                    {"parcels", parcels},
                    {"seconds_a_step", a_step},
                    {"steps_a_second", 1 / step.step},
                    {"liggghts", a_step / step.step},
                    {"parts", parts}};
  engine.reset();
  return rank == 0 ? result : Json();
}

/// Rows of the table, as tools/run_benchmarks.sh collects them.
void add_rows(const Json& found, std::vector<Json>& rows) {
  const auto add = [&](const std::string& metric, double value, const std::string& unit) {
    rows.push_back({{"bench", "dem"},
                    {"setting", "default"},
                    {"metric", metric},
                    {"value", value},
                    {"unit", unit},
                    {"ranks", found["ranks"]},
                    {"cells", found["cells"]},
                    {"parcels", found["parcels"]}});
    fmt::print("{:>7} parcels {:>7} cells {} rank(s) {:<56} {:>12.5g} {}\n", found["parcels"].get<std::int64_t>(),
               found["cells"].get<std::int64_t>(), found["ranks"].get<int>(), metric, value, unit);
  };
  const double liggghts = found["liggghts"];
  double rest = 0;
  for (const auto& [part, seconds] : found["parts"].items()) {
    rest += seconds.get<double>();
    add("wall_seconds_per_simulated_second: " + part, seconds, "1");
  }
  add("wall_seconds_per_simulated_second: LIGGGHTS steps", liggghts, "1");
  add("wall_seconds_per_simulated_second", liggghts + rest, "1");
  add("overhead_percent", 100 * rest / liggghts, "%");
  add("parcel_steps_per_core_second",
      found["parcels"].get<double>() / found["seconds_a_step"].get<double>() / found["ranks"].get<double>(), "1/s");
}

void run_all(const std::filesystem::path& program, const std::filesystem::path& work, const std::vector<int>& sizes,
             const std::filesystem::path& json) {
  setenv("OMPI_ALLOW_RUN_AS_ROOT", "1", 1);
  setenv("OMPI_ALLOW_RUN_AS_ROOT_CONFIRM", "1", 1);
  const auto run = [&](int ranks, const std::string& words) {
    const std::string command = fmt::format("{} --oversubscribe --bind-to none -n {} {} {} > {} 2>&1", CUPOLA_MPIEXEC,
                                            ranks, program.string(), words, (work / "run.log").string());
    if (std::system(command.c_str()) != 0) throw Failure(ExitCode::diverged, fmt::format("`{}` failed", command));
  };
  std::filesystem::remove_all(work);
  std::filesystem::create_directories(work);
  run(1, "settle " + work.string());
  std::vector<Json> rows;
  std::map<std::pair<int, int>, Json> found;
  for (const int tiles : sizes)
    for (const int ranks : {1, 2}) {
      const auto file = work / "found.json";
      run(ranks, fmt::format("measure {} --tiles {} --out {}", work.string(), tiles, file.string()));
      found[{tiles, ranks}] = read_json(file);
      add_rows(found[{tiles, ranks}], rows);
      if (ranks == 1) continue;
      const Json& two = found[{tiles, 2}];
      rows.push_back({{"bench", "dem"},
                      {"setting", "default"},
                      {"metric", "speed_up_over_one_rank"},
                      {"value", found[{tiles, 1}]["liggghts"].get<double>() / two["liggghts"].get<double>()},
                      {"unit", "1"},
                      {"ranks", 2},
                      {"cells", two["cells"]},
                      {"parcels", two["parcels"]}});
      fmt::print("{:>7} parcels: two ranks are {:.2f} times as fast as one\n", two["parcels"].get<std::int64_t>(),
                 rows.back()["value"].get<double>());
    }
  if (!json.empty()) write_json_atomically(json, rows);
  std::filesystem::remove_all(work);
}

}  // namespace
}  // namespace cupola::bench

int main(int argc, char** argv) {
  using namespace cupola;
  using namespace cupola::bench;
  CLI::App app{"Cost of the DEM stage by its parts"};
  std::filesystem::path json;
  std::filesystem::path work = std::filesystem::temp_directory_path() / "cupola_bench_dem";
  std::filesystem::path folder, out;
  std::vector<int> sizes{1, 4, 20};
  int tiles = 1;
  app.add_option("--json", json, "rows of the table");
  app.add_option("--work", work, "folder for the scenes");
  app.add_option("--sizes", sizes, "tiles of about 5,000 parcels");
  CLI::App* settling = app.add_subcommand("settle", "pour and settle the bed that is tiled");
  settling->add_option("FOLDER", folder)->required();
  CLI::App* measuring = app.add_subcommand("measure", "measure one size, on the ranks there are");
  measuring->add_option("FOLDER", folder)->required();
  measuring->add_option("--tiles", tiles);
  measuring->add_option("--out", out);
  CLI11_PARSE(app, argc, argv);
  try {
    if (settling->parsed()) {
      MPI_Init(&argc, &argv);
      settle(folder);
      MPI_Finalize();
    } else if (measuring->parsed()) {
      const Json result = measure(folder, tiles, argc, argv);
      if (!result.is_null()) write_json_atomically(out, result);
      MPI_Finalize();
    } else {
      run_all(std::filesystem::absolute(argv[0]), work, sizes, json);
    }
  } catch (const std::exception& error) {
    fmt::print(stderr, "{}\n", error.what());
    return 70;
  }
  return 0;
}
