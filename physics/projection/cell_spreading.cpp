#include "physics/projection/cell_spreading.hpp"

#include <algorithm>
#include <cmath>

#include "physics/equations/face_geometry.hpp"

namespace cupola {

CellSpreading::CellSpreading(const BedMesh& mesh, const std::vector<bool>& confined_to, double diameter)
    : inverse_volume_(mesh.cells()), work_(mesh.cells()) {
  for (std::size_t cell = 0; cell < mesh.cells(); ++cell) inverse_volume_[cell] = 1 / mesh.cell_volume[cell];
  const FaceGeometry geometry(mesh);
  const auto takes_part = [&](std::int64_t cell) { return confined_to.empty() || confined_to[cell]; };

  std::vector<double> sum(mesh.cells(), 0);
  for (std::size_t face = 0; face < mesh.faces(); ++face) {
    const auto owner = mesh.face_owner[face];
    const auto neighbour = mesh.face_neighbour[face];
    if (neighbour < 0 || neighbour == owner || !takes_part(owner) || !takes_part(neighbour)) continue;
    // Of a periodic pair of faces one is enough.
    const auto partner = mesh.face_partner[face];
    if (partner >= 0 && partner < static_cast<std::int64_t>(face)) continue;
    const double conductance =
        geometry.area[face] / (geometry.owner_distance[face] + geometry.neighbour_distance[face]);
    exchanges_.push_back({owner, neighbour, conductance});
    sum[owner] += conductance;
    sum[neighbour] += conductance;
  }

  // Positive weights need tau sum(A/d) <= V in every cell; half of that keeps the kernel's centre its largest weight.
  double stiffest = 0;
  for (std::size_t cell = 0; cell < mesh.cells(); ++cell) {
    stiffest = std::max(stiffest, sum[cell] * inverse_volume_[cell]);
  }
  const double tau_total = diameter * diameter / 40;
  passes_ = stiffest > 0 ? static_cast<int>(std::ceil(2 * tau_total * stiffest)) : 0;
  for (auto& exchange : exchanges_) exchange.conductance *= tau_total / passes_;
}

void CellSpreading::apply(std::vector<double>& sums) const {
  for (int pass = 0; pass < passes_; ++pass) {
    for (std::size_t cell = 0; cell < sums.size(); ++cell) work_[cell] = sums[cell] * inverse_volume_[cell];
    for (const auto& [first, second, conductance] : exchanges_) {
      const double moved = conductance * (work_[second] - work_[first]);
      sums[first] += moved;
      sums[second] -= moved;
    }
  }
}

void CellSpreading::gather(std::vector<double>& values) const {
  for (int pass = 0; pass < passes_; ++pass) {
    work_ = values;
    for (const auto& [first, second, conductance] : exchanges_) {
      const double moved = conductance * (work_[second] - work_[first]);
      values[first] += moved * inverse_volume_[first];
      values[second] -= moved * inverse_volume_[second];
    }
  }
}

std::vector<double> CellSpreading::gather(const std::vector<double>& values, const std::vector<double>& weights) const {
  std::vector<double> products(values.size());
  for (std::size_t cell = 0; cell < values.size(); ++cell) products[cell] = values[cell] * weights[cell];
  std::vector<double> sums = weights;
  gather(products);
  gather(sums);
  for (std::size_t cell = 0; cell < values.size(); ++cell) {
    products[cell] = sums[cell] > 0 ? products[cell] / sums[cell] : values[cell];
  }
  return products;
}

}  // namespace cupola
