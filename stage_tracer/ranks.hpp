#pragma once
#include <functional>
#include <vector>

#include "physics/projection/cells_of_rank.hpp"

namespace cupola {

/// Adds an array up over all ranks, in place; every rank gets the same sums.
using SumOverRanks = std::function<void(std::vector<double>&)>;

/// The sum over MPI_COMM_WORLD; nothing to do on one rank.
SumOverRanks sum_over_world();

/// Equal ranges of cells for all ranks of MPI_COMM_WORLD.
CellsOfRank share_cells(std::size_t cells);

/// Rows of all ranks one after the other, on rank 0 (empty elsewhere).
std::vector<double> gather_to_first(const std::vector<double>& local);

}  // namespace cupola
