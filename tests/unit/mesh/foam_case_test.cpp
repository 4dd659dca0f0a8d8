// Runs on one rank and under mpirun on several; rank 0 prepares the case.
#include "physics/mesh/foam_case.hpp"

#include <fenv.h>
#include <fvMesh.H>
#include <gtest/gtest.h>
#include <mpi.h>
#include <volFields.H>

#include <cmath>
#include <csignal>
#include <numeric>

#include "physics/mesh/prepare.hpp"
#include "schemas/failure.hpp"
#include "schemas/files.hpp"
#include "tests/support/furnaces.hpp"
#include "tests/support/temporary_folder.hpp"

namespace cupola {
namespace {

std::filesystem::path shared_folder;
FoamCase* foam_case = nullptr;
const BedMesh* bed_mesh = nullptr;

Task task_for(int ranks) {
  Task task;
  task.campaign = furnaces::shaft();
  task.campaign.launch.ranks = ranks;
  task.campaign_hash = hash_text("shaft");
  task.program_version = "test";
  return task;
}

std::size_t index(std::int64_t i) { return static_cast<std::size_t>(i); }

TEST(FoamCase, EveryCellIsOnOneRank) {
  const std::vector<double> ones(foam_case->global_cell().size(), 1.0);
  std::vector<double> count(bed_mesh->cells(), 0.0);
  for (const std::int64_t cell : foam_case->global_cell()) count[index(cell)] += 1;
  MPI_Allreduce(MPI_IN_PLACE, count.data(), static_cast<int>(count.size()), MPI_DOUBLE, MPI_SUM, MPI_COMM_WORLD);
  for (const double times : count) EXPECT_EQ(times, 1);
  EXPECT_EQ(foam_case->everywhere(ones).size(), bed_mesh->cells());
}

TEST(FoamCase, CellsAreThoseOfTheBedMesh) {
  const Foam::fvMesh& mesh = foam_case->mesh();
  ASSERT_EQ(static_cast<std::size_t>(mesh.nCells()), foam_case->global_cell().size());
  for (Foam::label i = 0; i < mesh.nCells(); ++i) {
    const std::size_t cell = index(foam_case->global_cell()[index(i)]);
    EXPECT_NEAR(mesh.V()[i], bed_mesh->cell_volume[cell], 1e-14);
    for (std::size_t k = 0; k < 3; ++k) {
      EXPECT_NEAR(mesh.C()[i][static_cast<Foam::direction>(k)], bed_mesh->cell_centre[cell][k], 1e-12);
    }
  }
}

TEST(FoamCase, CellValuesGoThereAndBack) {
  std::vector<double> all(bed_mesh->cells());
  std::iota(all.begin(), all.end(), 0.5);
  EXPECT_EQ(foam_case->everywhere(foam_case->local(all)), all);
  std::vector<double> centres;
  for (Foam::label i = 0; i < foam_case->mesh().nCells(); ++i) {
    for (std::size_t k = 0; k < 3; ++k)
      centres.push_back(bed_mesh->cell_centre[index(foam_case->global_cell()[index(i)])][k]);
  }
  const std::vector<double> everywhere = foam_case->everywhere(centres, 3);
  for (std::size_t cell = 0; cell < bed_mesh->cells(); ++cell) {
    for (std::size_t k = 0; k < 3; ++k) EXPECT_EQ(everywhere[3 * cell + k], bed_mesh->cell_centre[cell][k]);
  }
}

TEST(FoamCase, FluxesKeepTheirSense) {
  // The flux of a constant field through every face, from OpenFOAM's areas on the ranks and from BedMesh's.
  const Vector3 field{1.0, 2.0, -3.0};
  const Foam::fvMesh& mesh = foam_case->mesh();
  std::vector<double> local(index(mesh.nFaces()));
  for (Foam::label i = 0; i < mesh.nFaces(); ++i) {
    const Foam::vector& area = mesh.faceAreas()[i];
    local[index(i)] = area.x() * field[0] + area.y() * field[1] + area.z() * field[2];
  }
  const std::vector<double> all = foam_case->fluxes_everywhere(local);
  ASSERT_EQ(all.size(), bed_mesh->faces());
  for (std::size_t face = 0; face < all.size(); ++face) {
    const Vector3& area = bed_mesh->face_area[face];
    EXPECT_NEAR(all[face], area[0] * field[0] + area[1] * field[1] + area[2] * field[2], 1e-13) << face;
  }
  const std::vector<double> back = foam_case->local_fluxes(all);
  for (std::size_t i = 0; i < back.size(); ++i) EXPECT_NEAR(back[i], local[i], 1e-13);
}

void on_interrupt(int /*signal*/) {}

TEST(FoamCase, LeavesSignalsAndFloatingPointTrapsAlone) {
  EXPECT_EQ(fegetexcept(), 0);
  struct sigaction action {};
  sigaction(SIGINT, nullptr, &action);
  EXPECT_EQ(action.sa_handler, &on_interrupt);
}

TEST(FoamCase, WrongNumberOfRanksIsRefused) {
  int argc = 0;
  char** argv = nullptr;
  EXPECT_THROW(FoamCase(shared_folder / "other" / "foam", argc, argv), Failure);
  EXPECT_THROW(FoamCase(shared_folder / "absent" / "foam", argc, argv), Failure);
}

}  // namespace
}  // namespace cupola

int main(int argc, char** argv) {
  MPI_Init(&argc, &argv);
  testing::InitGoogleTest(&argc, argv);
  int rank = 0;
  int ranks = 1;
  MPI_Comm_rank(MPI_COMM_WORLD, &rank);
  MPI_Comm_size(MPI_COMM_WORLD, &ranks);
  cupola::shared_folder = argv[1];
  if (rank == 0) {
    std::filesystem::remove_all(cupola::shared_folder);
    std::filesystem::create_directories(cupola::shared_folder / "other");
    cupola::prepare(cupola::shared_folder, cupola::task_for(ranks));
    cupola::prepare(cupola::shared_folder / "other", cupola::task_for(ranks + 1));
  }
  MPI_Barrier(MPI_COMM_WORLD);
  const cupola::BedMesh mesh = cupola::BedMesh::read(cupola::shared_folder / "foam" / "mesh.hdf");
  std::signal(SIGINT, &cupola::on_interrupt);
  cupola::FoamCase foam(cupola::shared_folder / "foam", argc, argv);
  cupola::bed_mesh = &mesh;
  cupola::foam_case = &foam;
  const int failed = RUN_ALL_TESTS();
  // FoamCase must not end the process with a status of its own: ctest asks for this one.
  return failed != 0 ? 1 : argc > 2 ? std::stoi(argv[2]) : 0;
}
