#include "stage_tracer/predictor/streamlines.hpp"

#include <algorithm>

namespace cupola {
namespace {

/// Longer than any path takes; what stands still in a cell without an outflow stays there for ever.
constexpr double for_ever = 1e15;

void keep_stay(void* context, std::int64_t cell, double seconds) {
  auto& stays = *static_cast<std::vector<Streamlines::Stay>*>(context);
  stays.push_back({static_cast<std::int32_t>(cell), seconds});
}

}  // namespace

Streamlines::Streamlines(const BedMesh& mesh, const std::vector<double>& face_flux,
                         const std::vector<StockFace>& stock_faces, const std::vector<double>& persistent_flux,
                         int lines_per_edge, int rank, int ranks) {
  const PathField paths(mesh, face_flux, std::vector<double>(mesh.cells(), 1.0));
  long number = 0;
  for (std::size_t f = 0; f < stock_faces.size(); ++f) {
    const auto& sides = mesh.cell_faces[stock_faces[f].cell];
    const auto side =
        static_cast<std::size_t>(std::find(sides.begin(), sides.end(), stock_faces[f].face) - sides.begin());
    const std::size_t across = side / 2;
    for (int i = 0; i < lines_per_edge; ++i) {
      for (int j = 0; j < lines_per_edge; ++j) {
        if (number++ % ranks != rank) continue;
        PathField::Point point{stock_faces[f].cell, {}};
        point.reference[across] = side % 2 == 0 ? 0 : 1;
        point.reference[(across + 1) % 3] = (i + 0.5) / lines_per_edge;
        point.reference[(across + 2) % 3] = (j + 0.5) / lines_per_edge;
        const std::size_t first = stays_.size();
        paths.advance(point, for_ever, &keep_stay, &stays_);
        lines_.push_back({persistent_flux[f] / (lines_per_edge * lines_per_edge), first, stays_.size()});
      }
    }
  }
}

}  // namespace cupola
