#pragma once
#include <functional>
#include <vector>

#include "orchestrator/study/study_fields.hpp"

namespace cupola {

/// Means over blocks, weighted by the solids' volume in them.
struct BlockMeans {
  std::vector<double> weight;  ///< by block: volume of solids, m3
  std::vector<double> value;   ///< by block, `columns` each
};

/// Centres of the cells (mean of the corners), x 3, m.
std::vector<double> cell_centres(const StudyFields& fields);

/// Blocks across and up, over the whole depth, on which two meshes are compared: as wide and high as the coarser mesh's
/// mean cell.  A cell gives each block the share of it that lies there, by 4 x 4 x 4 points of its trilinear map.
class StudyBlocks {
 public:
  StudyBlocks(const StudyFields& one, const StudyFields& other);
  [[nodiscard]] BlockMeans means(const StudyFields& fields, const std::vector<double>& values,
                                 std::size_t columns) const;
  [[nodiscard]] double size() const { return size_; }

 private:
  double size_ = 0;                  ///< m
  double left_ = 0, bottom_ = 0;     ///< m
  std::size_t across_ = 0, up_ = 0;  ///< blocks
};

}  // namespace cupola
