#pragma once
#include <cstddef>
#include <functional>
#include <vector>

namespace cupola {

/// How work on arrays over all cells is shared out among ranks: each rank works out the values of its own range of
/// cells, then `complete` gives every rank the ranges of the others.
struct CellsOfRank {
  std::size_t begin = 0;
  std::size_t end = 0;
  /// Fills in the other ranks' ranges of each array (size: all cells), on all ranks together; empty on one rank.
  std::function<void(const std::vector<std::vector<double>*>&)> others;

  void complete(const std::vector<std::vector<double>*>& arrays) const {
    if (others) others(arrays);
  }

  /// All of `cells` on one rank.
  static CellsOfRank all(std::size_t cells) { return {0, cells, {}}; }
};

}  // namespace cupola
