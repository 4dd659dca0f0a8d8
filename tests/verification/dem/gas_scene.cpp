#include "tests/verification/dem/gas_scene.hpp"

#include <mpi.h>

#include "physics/mesh/prepare.hpp"
#include "tests/support/foam_scene.hpp"
#include "tests/unit/dem/box_scene.hpp"

namespace cupola::test {
namespace {

std::filesystem::path prepared(Campaign campaign) {
  const auto folder = test_folder();
  int rank = 0;
  MPI_Comm_rank(MPI_COMM_WORLD, &rank);
  MPI_Comm_size(MPI_COMM_WORLD, &campaign.launch.ranks);
  if (rank == 0) {
    std::filesystem::remove_all(folder / "foam");
    prepare(folder, task_of(campaign));
  }
  MPI_Barrier(MPI_COMM_WORLD);
  return folder;
}

}  // namespace

GasScene::GasScene(const Campaign& campaign)
    : folder_(prepared(campaign)),
      foam(folder_ / "foam", argc_, argv_),
      mesh(BedMesh::read(folder_ / "foam" / "mesh.hdf")) {}

}  // namespace cupola::test
