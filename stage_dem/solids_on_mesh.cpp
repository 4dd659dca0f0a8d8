#include "stage_dem/solids_on_mesh.hpp"

#include <algorithm>

#include "stage_dem/parcels.hpp"

namespace cupola {

SolidsOnMesh::SolidsOnMesh(const BedMesh& mesh, const Campaign& campaign, MPI_Comm communicator)
    : mesh_(mesh), campaign_(campaign), communicator_(communicator), locator_(mesh) {
  if (campaign.dem.void_fraction == DemSettings::VoidFraction::smoothed)
    smoothing_.emplace(mesh, std::vector<bool>{}, campaign.dem.smoothing_length);
}

void SolidsOnMesh::divide(const std::vector<Parcel>& owned) {
  first_.assign(1, 0);
  shares_.clear();
  cell_.clear();
  std::vector<CellShare> divided;
  for (const auto& parcel : owned) {
    divided.clear();
    // No guess is kept from block to block: on a face the answer could depend on it, and a resumed run has none.
    std::int64_t cell = -1;
    const std::size_t number = divide_parcel(locator_, parcel.position, parcel.radius, cell, divided);
    // Softened and overlapping parcels may stand a little outside a wall; above the mesh is the hopper.
    if (number == 0 && parcel.position[2] < mesh_.upper[2]) {
      cell = locator_.nearest(parcel.position);
      if (cell >= 0) divided.assign(1, {cell, 1.0});
    }
    shares_.insert(shares_.end(), divided.begin(), divided.end());
    first_.push_back(shares_.size());
    cell_.push_back(divided.empty() ? -1 : cell);
  }
  const std::size_t species = campaign_.species.size();
  const auto flat = sums(species, [&](std::size_t i, std::span<double> value) {
    value[static_cast<std::size_t>(owned[i].species)] = material_volume(campaign_, owned[i]);
    return true;
  });
  species_volume_.assign(species, std::vector<double>(mesh_.cells()));
  volume_.assign(mesh_.cells(), 0);
  for (std::size_t cell = 0; cell < mesh_.cells(); ++cell)
    for (std::size_t s = 0; s < species; ++s) {
      species_volume_[s][cell] = flat[cell * species + s];
      volume_[cell] += flat[cell * species + s];
    }
}

std::span<const CellShare> SolidsOnMesh::shares(std::size_t parcel) const {
  return std::span(shares_).subspan(first_[parcel], first_[parcel + 1] - first_[parcel]);
}

std::vector<double> SolidsOnMesh::sums(std::size_t columns,
                                       const std::function<bool(std::size_t, std::span<double>)>& value) const {
  std::vector<double> sum(mesh_.cells() * columns, 0.0);
  std::vector<double> values(columns);
  for (std::size_t i = 0; i + 1 < first_.size(); ++i) {
    if (first_[i] == first_[i + 1]) continue;
    std::fill(values.begin(), values.end(), 0.0);
    if (!value(i, values)) continue;
    for (const auto& [cell, share] : shares(i))
      for (std::size_t k = 0; k < columns; ++k) sum[static_cast<std::size_t>(cell) * columns + k] += share * values[k];
  }
  MPI_Allreduce(MPI_IN_PLACE, sum.data(), static_cast<int>(sum.size()), MPI_DOUBLE, MPI_SUM, communicator_);
  if (!smoothing_) return sum;
  std::vector<double> column(mesh_.cells());
  for (std::size_t k = 0; k < columns; ++k) {
    for (std::size_t cell = 0; cell < column.size(); ++cell) column[cell] = sum[cell * columns + k];
    smoothing_->apply(column);
    for (std::size_t cell = 0; cell < column.size(); ++cell) sum[cell * columns + k] = column[cell];
  }
  return sum;
}

}  // namespace cupola
