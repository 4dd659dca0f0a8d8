#include "physics/projection/cell_spreading.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "physics/equations/face_geometry.hpp"

namespace cupola {

CellSpreading::CellSpreading(const BedMesh& mesh, const std::vector<bool>& confined_to, double diameter,
                             CellsOfRank share)
    : neighbours_(mesh.cells()), inverse_volume_(mesh.cells()), share_(std::move(share)) {
  if (share_.end == 0) share_ = CellsOfRank::all(mesh.cells());
  for (std::size_t cell = 0; cell < mesh.cells(); ++cell) inverse_volume_[cell] = 1 / mesh.cell_volume[cell];
  const FaceGeometry geometry(mesh);
  const auto takes_part = [&](std::int64_t cell) { return confined_to.empty() || confined_to[cell]; };

  std::vector<double> sum(mesh.cells(), 0);
  for (std::size_t cell = 0; cell < mesh.cells(); ++cell) {
    Neighbours& around = neighbours_[cell];
    around.cell.fill(static_cast<std::int32_t>(cell));
    for (std::size_t side = 0; side < 6; ++side) {
      const auto face = mesh.cell_faces[cell][side];
      const auto neighbour = mesh.across(static_cast<std::int64_t>(cell), face);
      if (neighbour < 0 || neighbour == static_cast<std::int64_t>(cell) || !takes_part(neighbour) ||
          !takes_part(static_cast<std::int64_t>(cell))) {
        continue;
      }
      // Of a periodic pair of faces both cells take the same one, so that they agree to the last digit.
      const auto partner = mesh.face_partner[face];
      const auto one = partner >= 0 && partner < face ? partner : face;
      around.cell[side] = static_cast<std::int32_t>(neighbour);
      around.conductance[side] = geometry.area[one] / (geometry.owner_distance[one] + geometry.neighbour_distance[one]);
      sum[cell] += around.conductance[side];
    }
  }

  // Positive weights need tau sum(A/d) <= V in every cell; half of that keeps the kernel's centre its largest weight.
  double stiffest = 0;
  for (std::size_t cell = 0; cell < mesh.cells(); ++cell) {
    stiffest = std::max(stiffest, sum[cell] * inverse_volume_[cell]);
  }
  const double tau_total = diameter * diameter / 40;
  passes_ = stiffest > 0 ? static_cast<int>(std::ceil(2 * tau_total * stiffest)) : 0;
  for (std::size_t cell = 0; cell < mesh.cells(); ++cell) {
    for (double& conductance : neighbours_[cell].conductance) conductance *= tau_total / std::max(passes_, 1);
    neighbours_[cell].kept = 1 - sum[cell] * tau_total / std::max(passes_, 1) * inverse_volume_[cell];
  }
}

template <bool spreads>
void CellSpreading::pass(const std::vector<std::vector<double>*>& arrays) const {
  const std::size_t count = arrays.size();
  const std::size_t cells = inverse_volume_.size();
  // Side by side, so that a neighbour's values of all arrays lie together.
  work_.resize(cells * count);
  for (std::size_t k = 0; k < count; ++k) {
    const std::vector<double>& values = *arrays[k];
    for (std::size_t cell = 0; cell < cells; ++cell)
      work_[cell * count + k] = spreads ? values[cell] * inverse_volume_[cell] : values[cell];
  }
  std::vector<double> inflow(count);
  for (std::size_t cell = share_.begin; cell < share_.end; ++cell) {
    const Neighbours& around = neighbours_[cell];
    std::fill(inflow.begin(), inflow.end(), 0.0);
    for (std::size_t side = 0; side < 6; ++side) {
      const double* there = &work_[static_cast<std::size_t>(around.cell[side]) * count];
      for (std::size_t k = 0; k < count; ++k) inflow[k] += around.conductance[side] * there[k];
    }
    for (std::size_t k = 0; k < count; ++k) {
      double& value = (*arrays[k])[cell];
      value = value * around.kept + (spreads ? inflow[k] : inflow[k] * inverse_volume_[cell]);
    }
  }
  share_.complete(arrays);
}

void CellSpreading::apply(const std::vector<std::vector<double>*>& sums) const {
  for (int i = 0; i < passes_; ++i) pass<true>(sums);
}

void CellSpreading::gather(const std::vector<std::vector<double>*>& values) const {
  for (int i = 0; i < passes_; ++i) pass<false>(values);
}

std::vector<double> CellSpreading::gather(const std::vector<double>& values, const std::vector<double>& weights) const {
  std::vector<double> products(values.size());
  for (std::size_t cell = 0; cell < values.size(); ++cell) products[cell] = values[cell] * weights[cell];
  std::vector<double> sums = weights;
  gather({&products, &sums});
  for (std::size_t cell = 0; cell < values.size(); ++cell) {
    products[cell] = sums[cell] > 0 ? products[cell] / sums[cell] : values[cell];
  }
  return products;
}

}  // namespace cupola
