#include "stage_tracer/ranks.hpp"

#include <mpi.h>

namespace cupola {

SumOverRanks sum_over_world() {
  int ranks = 1;
  MPI_Comm_size(MPI_COMM_WORLD, &ranks);
  if (ranks == 1) return [](std::vector<double>&) {};
  return [](std::vector<double>& values) {
    MPI_Allreduce(MPI_IN_PLACE, values.data(), static_cast<int>(values.size()), MPI_DOUBLE, MPI_SUM, MPI_COMM_WORLD);
  };
}

CellsOfRank share_cells(std::size_t cells) {
  int rank = 0;
  int ranks = 1;
  MPI_Comm_rank(MPI_COMM_WORLD, &rank);
  MPI_Comm_size(MPI_COMM_WORLD, &ranks);
  if (ranks == 1) return CellsOfRank::all(cells);
  std::vector<int> begins;
  std::vector<int> counts;
  for (int r = 0; r < ranks; ++r) {
    const auto number = [&](int k) { return static_cast<int>(cells * static_cast<std::size_t>(k) / ranks); };
    begins.push_back(number(r));
    counts.push_back(number(r + 1) - number(r));
  }
  CellsOfRank share;
  share.begin = static_cast<std::size_t>(begins[rank]);
  share.end = share.begin + static_cast<std::size_t>(counts[rank]);
  share.others = [begins, counts](const std::vector<std::vector<double>*>& arrays) {
    for (std::vector<double>* array : arrays) {
      MPI_Allgatherv(MPI_IN_PLACE, 0, MPI_DATATYPE_NULL, array->data(), counts.data(), begins.data(), MPI_DOUBLE,
                     MPI_COMM_WORLD);
    }
  };
  return share;
}

std::vector<double> gather_to_first(const std::vector<double>& local) {
  int rank = 0;
  int ranks = 1;
  MPI_Comm_rank(MPI_COMM_WORLD, &rank);
  MPI_Comm_size(MPI_COMM_WORLD, &ranks);
  if (ranks == 1) return local;
  const int count = static_cast<int>(local.size());
  std::vector<int> counts(static_cast<std::size_t>(ranks));
  MPI_Gather(&count, 1, MPI_INT, counts.data(), 1, MPI_INT, 0, MPI_COMM_WORLD);
  std::vector<int> begins(counts.size(), 0);
  for (std::size_t r = 1; r < counts.size(); ++r) begins[r] = begins[r - 1] + counts[r - 1];
  std::vector<double> all(rank == 0 ? static_cast<std::size_t>(begins.back() + counts.back()) : 0);
  MPI_Gatherv(local.data(), count, MPI_DOUBLE, all.data(), counts.data(), begins.data(), MPI_DOUBLE, 0, MPI_COMM_WORLD);
  return all;
}

}  // namespace cupola
