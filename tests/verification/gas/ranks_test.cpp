// The same furnace on one and on two ranks: flow, gas energy and cleaning must give the same arrays.
//   ranks_test one FOLDER            prepares FOLDER/1 and FOLDER/2, solves on one rank, keeps the result
//   mpirun -n 2 ranks_test two FOLDER   solves on two ranks and compares
#include <fmt/format.h>
#include <mpi.h>

#include <cmath>
#include <cstdio>
#include <string>
#include <vector>

#include "physics/gas/bed_gas.hpp"
#include "physics/projection/clean_field.hpp"
#include "schemas/files.hpp"
#include "tests/support/foam_scene.hpp"
#include "tests/support/furnaces.hpp"

namespace cupola {
namespace {

/// Flow and temperature in turns, then a cleaned field: everything that depends on the decomposition, by name.
nlohmann::json solve(const Campaign& campaign, const std::filesystem::path& folder, int& argc, char**& argv) {
  FoamCase foam(folder / "foam", argc, argv);
  const BedMesh mesh = BedMesh::read(folder / "foam" / "mesh.hdf");
  auto bed = uniform_bed(mesh, 0.42, 0.03);
  SolidsExchange exchange;
  RawGranularField raw;
  raw.smoothing_passes = 2;
  for (std::size_t cell = 0; cell < mesh.cells(); ++cell) {
    const Vector3& c = mesh.cell_centre[cell];
    if (c[2] > 6.1) bed.void_fraction[cell] = 1;
    const double conductance = 500 * mesh.cell_volume[cell];
    exchange.conductance.push_back(conductance);
    exchange.conductance_temperature.push_back(conductance * (500 + 100 * std::sin(3 * c[0] + 5 * c[1] + c[2])));
    raw.bed.push_back(c[2] < 6.1);
    raw.coke_flux.push_back(
        {1e-3 * std::sin(4 * c[2]), 1e-3 * std::cos(9 * c[1]), -2e-3 * (1 + 0.3 * std::sin(5 * c[0]))});
    raw.sink.push_back(std::abs(c[0]) > 0.9 && std::abs(c[2]) < 0.4 ? 5e-3 : 0);
  }
  DarcyForchheimer flow(foam, mesh, campaign);
  GasEnergy energy(foam, mesh, campaign);
  for (int turn = 0; turn < 4; ++turn) {
    flow.solve(bed, energy.temperature(), 1e-9, 60);
    energy.solve(flow, bed, exchange);
  }
  return {{"pressure", flow.pressure()},
          {"face mass flux", flow.face_mass_flux()},
          {"temperature", energy.temperature()},
          {"granular flux", clean_granular_field(foam, mesh, raw).face_flux}};
}

/// Largest difference over the largest value.
double difference(const std::vector<double>& a, const std::vector<double>& b) {
  double wrong = a.size() == b.size() ? 0 : 1, usual = 0;
  for (std::size_t i = 0; i < std::min(a.size(), b.size()); ++i) {
    wrong = std::max(wrong, std::abs(a[i] - b[i]));
    usual = std::max(usual, std::abs(b[i]));
  }
  return wrong / usual;
}

int run(int argc, char** argv) {
  const bool two = std::string(argv[1]) == "two";
  const std::filesystem::path folder = argv[2];
  Campaign campaign = furnaces::shaft();
  campaign.scene.heat_loss = WallHeatLoss{20, 293};
  if (!two) {
    std::filesystem::remove_all(folder);
    for (const int ranks : {1, 2}) {
      campaign.launch.ranks = ranks;
      std::filesystem::create_directories(folder / std::to_string(ranks));
      prepare(folder / std::to_string(ranks), task_of(campaign));
    }
    write_json_atomically(folder / "one.json", solve(campaign, folder / "1", argc, argv));
    return 0;
  }
  const auto found = solve(campaign, folder / "2", argc, argv);
  const auto expected = read_json(folder / "one.json");
  int rank = 0;
  MPI_Comm_rank(MPI_COMM_WORLD, &rank);
  bool same = true;
  for (const auto& [name, values] : expected.items()) {
    const double wrong = difference(found.at(name).get<std::vector<double>>(), values.get<std::vector<double>>());
    fmt::print("rank {}: {} differs by {:.2e}\n", rank, name, wrong);
    same = same && wrong < 1e-8;
  }
  return same ? 0 : 1;
}

}  // namespace
}  // namespace cupola

int main(int argc, char** argv) {
  try {
    return cupola::run(argc, argv);
  } catch (const std::exception& error) {
    fmt::print(stderr, "{}\n", error.what());
    return 1;
  }
}
