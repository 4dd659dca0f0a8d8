#include "stage_tracer/predictor/streamlines.hpp"

#include <algorithm>
#include <numeric>

namespace cupola {
namespace {

/// Paths are followed for so many times as long as the bed's whole flux would need to fill it: those that still run in
/// circles then count as lost.
constexpr int most_fillings = 8;
/// Of a path's flux no more than exp(-x) is left: it has been used up.
constexpr double used_up = 30;

/// The stays of one line, and how much of it they use up.
struct Path {
  std::vector<Streamlines::Stay>& stays;
  const std::vector<double>& sink;
  std::size_t first;
  double removal = 0;
};

void keep_stay(void* context, std::int64_t cell, double seconds) {
  Path& path = *static_cast<Path*>(context);
  path.removal += path.sink[cell] * seconds;
  if (path.stays.size() > path.first && path.stays.back().cell == cell) {
    path.stays.back().time += seconds;
  } else {
    path.stays.push_back({static_cast<std::int32_t>(cell), seconds});
  }
}

}  // namespace

Streamlines::Streamlines(const BedMesh& mesh, const std::vector<double>& face_flux,
                         const std::vector<StockFace>& stock_faces, const std::vector<double>& persistent_flux,
                         const std::vector<double>& sink, std::array<int, 2> lines_across, int rank, int ranks) {
  const PathField paths(mesh, face_flux, std::vector<double>(mesh.cells(), 1.0));
  const double filling = std::accumulate(mesh.cell_volume.begin(), mesh.cell_volume.end(), 0.0) /
                         std::accumulate(persistent_flux.begin(), persistent_flux.end(), 0.0);
  long number = 0;
  for (std::size_t f = 0; f < stock_faces.size(); ++f) {
    const auto& sides = mesh.cell_faces[stock_faces[f].cell];
    const auto side =
        static_cast<std::size_t>(std::find(sides.begin(), sides.end(), stock_faces[f].face) - sides.begin());
    const std::size_t across = side / 2;
    for (int i = 0; i < lines_across[0]; ++i) {
      for (int j = 0; j < lines_across[1]; ++j) {
        if (number++ % ranks != rank) continue;
        PathField::Point point{stock_faces[f].cell, {}};
        point.reference[across] = side % 2 == 0 ? 0 : 1;
        point.reference[(across + 1) % 3] = (i + 0.5) / lines_across[0];
        point.reference[(across + 2) % 3] = (j + 0.5) / lines_across[1];
        const std::size_t first = stays_.size();
        Path path{stays_, sink, first};
        for (int fillings = 0; fillings < most_fillings && path.removal < used_up; ++fillings)
          if (paths.advance(point, filling, &keep_stay, &path) != PathField::End::time_up) break;
        lines_.push_back({persistent_flux[f] / (lines_across[0] * lines_across[1]), first, stays_.size()});
      }
    }
  }
}

}  // namespace cupola
