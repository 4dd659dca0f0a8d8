#include "stage_dem/bed_sample.hpp"

#include <algorithm>

#include "stage_dem/parcels.hpp"

namespace cupola {
namespace {

BedSample nothing(std::size_t cells) {
  return {std::vector<double>(cells), std::vector<double>(cells), std::vector<double>(3 * cells)};
}

void add(std::vector<double>& sum, const std::vector<double>& values) {
  for (std::size_t i = 0; i < sum.size(); ++i) sum[i] += values[i];
}

}  // namespace

std::vector<BedSample> sample_bed(const Campaign& campaign, const BedMesh& mesh, const SolidsOnMesh& solids,
                                  const std::vector<Parcel>& owned, const std::set<std::int64_t>& falling,
                                  double seconds) {
  constexpr std::size_t columns = 5;  // material and contact volume, material volume x velocity
  const std::size_t species = campaign.species.size();
  const auto sums = solids.sums(columns * species, [&](std::size_t i, std::span<double> all) {
    if (falling.contains(owned[i].id)) return false;
    std::fill(all.begin(), all.end(), 0.0);
    const auto value = all.subspan(columns * static_cast<std::size_t>(owned[i].species), columns);
    const double volume = material_volume(campaign, owned[i]);
    value[0] = volume;
    value[1] = contact_volume(owned[i]);
    for (std::size_t k = 0; k < 3; ++k) value[2 + k] = volume * owned[i].displacement[k] / seconds;
    return true;
  });
  std::vector<BedSample> samples(species, nothing(mesh.cells()));
  for (std::size_t cell = 0; cell < mesh.cells(); ++cell)
    for (std::size_t s = 0; s < species; ++s) {
      const double* row = &sums[(cell * species + s) * columns];
      samples[s].fraction[cell] = row[0] / mesh.cell_volume[cell];
      samples[s].contact_fraction[cell] = row[1] / mesh.cell_volume[cell];
      for (std::size_t k = 0; k < 3; ++k) samples[s].flux[3 * cell + k] = row[2 + k] / mesh.cell_volume[cell];
    }
  return samples;
}

BedSample sum_of(const std::vector<BedSample>& species) {
  BedSample all = nothing(species.front().fraction.size());
  for (const auto& one : species) {
    add(all.fraction, one.fraction);
    add(all.contact_fraction, one.contact_fraction);
    add(all.flux, one.flux);
  }
  return all;
}

}  // namespace cupola
