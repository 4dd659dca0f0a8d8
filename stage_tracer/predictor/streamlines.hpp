#pragma once
#include <array>
#include <cstdint>
#include <vector>

#include "physics/motion/path.hpp"
#include "stage_tracer/granular_field.hpp"

namespace cupola {

/// The paths of the granular flux from the stock plane to their ends, as the cells they pass and how long they stay.
///
/// A path's geometry depends on the flux alone: with the velocity q/storage the time spent in a cell is storage times
/// the time that the flux itself would need.  So the stays are kept for a storage of 1 and serve any packing.
class Streamlines {
 public:
  struct Stay {
    std::int32_t cell;
    double time;  ///< s, at a storage of 1
  };
  struct Line {
    double flux = 0;  ///< m3/s of the persistent species, at the stock plane
    std::size_t first = 0;
    std::size_t end = 0;  ///< its stays are [first, end)
  };

  /// Follows lines from points spread evenly over each stock face's reference coordinates, in which the flux of a face
  /// is even, so that all lines of a face carry the same.  Of a deterministic list each rank takes every `ranks`-th.
  /// @param persistent_flux m3/s through each of the stock faces
  /// @param sink            of the persistent species, 1/s, all cells: a line ends where it is used up
  /// @param lines_across    lines along each stock face in x and in y
  Streamlines(const BedMesh& mesh, const std::vector<double>& face_flux, const std::vector<StockFace>& stock_faces,
              const std::vector<double>& persistent_flux, const std::vector<double>& sink,
              std::array<int, 2> lines_across, int rank, int ranks);

  [[nodiscard]] const std::vector<Line>& lines() const { return lines_; }
  [[nodiscard]] const std::vector<Stay>& stays() const { return stays_; }

 private:
  std::vector<Line> lines_;
  std::vector<Stay> stays_;
};

}  // namespace cupola
