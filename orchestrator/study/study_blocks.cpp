#include "orchestrator/study/study_blocks.hpp"

#include <algorithm>
#include <array>
#include <cmath>

namespace cupola {
namespace {

constexpr int points_a_side = 4;
constexpr std::size_t corners = 8;

double mean_cell_size(const StudyFields& fields) {
  double volume = 0;
  for (const double one : fields.cell_volume) volume += one;
  return std::cbrt(volume / static_cast<double>(fields.cell_volume.size()));
}

/// Weights of the corners (VTK's order: lower ring, upper ring) at (u, v, w) in [0, 1].
std::array<double, corners> trilinear(double u, double v, double w) {
  const std::array<double, 4> ring = {(1 - u) * (1 - v), u * (1 - v), u * v, (1 - u) * v};
  std::array<double, corners> weights{};
  for (std::size_t i = 0; i < 4; ++i) {
    weights.at(i) = (1 - w) * ring.at(i);
    weights.at(i + 4) = w * ring.at(i);
  }
  return weights;
}

}  // namespace

std::vector<double> cell_centres(const StudyFields& fields) {
  std::vector<double> centres(3 * fields.cell_volume.size(), 0.);
  for (std::size_t cell = 0; cell < fields.cell_volume.size(); ++cell)
    for (std::size_t i = 0; i < corners; ++i)
      for (std::size_t c = 0; c < 3; ++c)
        centres[3 * cell + c] +=
            fields.points[3 * static_cast<std::size_t>(fields.cell_points[corners * cell + i]) + c] / corners;
  return centres;
}

StudyBlocks::StudyBlocks(const StudyFields& one, const StudyFields& other)
    : size_(std::max(mean_cell_size(one), mean_cell_size(other))) {
  left_ = bottom_ = HUGE_VAL;
  double right = -HUGE_VAL, top = -HUGE_VAL;
  for (const StudyFields* fields : {&one, &other})
    for (std::size_t i = 0; i < fields->points.size(); i += 3) {
      left_ = std::min(left_, fields->points[i]);
      right = std::max(right, fields->points[i]);
      bottom_ = std::min(bottom_, fields->points[i + 2]);
      top = std::max(top, fields->points[i + 2]);
    }
  across_ = static_cast<std::size_t>((right - left_) / size_) + 1;
  up_ = static_cast<std::size_t>((top - bottom_) / size_) + 1;
}

BlockMeans StudyBlocks::means(const StudyFields& fields, const std::vector<double>& values, std::size_t columns) const {
  BlockMeans means{std::vector<double>(across_ * up_, 0.), std::vector<double>(columns * across_ * up_, 0.)};
  for (std::size_t cell = 0; cell < fields.solids_volume.size(); ++cell) {
    const double weight = fields.solids_volume[cell] / std::pow(points_a_side, 3);
    if (weight <= 0) continue;
    for (int point = 0; point < points_a_side * points_a_side * points_a_side; ++point) {
      const auto place = [&](int index) { return (index % points_a_side + 0.5) / points_a_side; };
      const auto shares =
          trilinear(place(point), place(point / points_a_side), place(point / points_a_side / points_a_side));
      double x = 0, z = 0;
      for (std::size_t i = 0; i < corners; ++i) {
        const auto at = 3 * static_cast<std::size_t>(fields.cell_points[corners * cell + i]);
        x += shares.at(i) * fields.points[at];
        z += shares.at(i) * fields.points[at + 2];
      }
      const std::size_t block =
          static_cast<std::size_t>((x - left_) / size_) + across_ * static_cast<std::size_t>((z - bottom_) / size_);
      means.weight[block] += weight;
      for (std::size_t c = 0; c < columns; ++c) means.value[columns * block + c] += weight * values[columns * cell + c];
    }
  }
  for (std::size_t block = 0; block < means.weight.size(); ++block)
    for (std::size_t c = 0; c < columns; ++c)
      if (means.weight[block] > 0) means.value[columns * block + c] /= means.weight[block];
  return means;
}

}  // namespace cupola
