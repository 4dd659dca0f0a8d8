#include "stage_tracer/bed_composition.hpp"

#include "physics/closures/softening.hpp"

namespace cupola {

BySpecies bed_composition(const BedMesh& mesh, const Campaign& campaign, const GranularField& field,
                          const CellContents& contents, const std::vector<double>& empty_share) {
  BySpecies volume = volume_shares(contents, empty_share);
  const bool heat = !contents.temperature.empty();
  for (std::size_t c = 0; c < mesh.cells(); ++c) {
    double reached = 0;
    double contact = 0;  // contact volume a material volume
    for (std::size_t s = 0; s < volume.size(); ++s) {
      reached += contents.volume[s][c];
      const auto& softening = campaign.species[s].softening;
      contact += volume[s][c] / (heat && softening ? volume_factor(contents.temperature[s][c], *softening) : 1.0);
    }
    double solids = 0;
    if (field.bed[c])
      solids = reached > 0 && contact > 0 ? field.contact_fraction[c] / contact : field.solids_fraction[c];
    for (auto& of_species : volume) of_species[c] *= solids * mesh.cell_volume[c];
  }
  return volume;
}

std::vector<double> share_of_persistent(const Campaign& campaign, const Charge& charge) {
  const std::vector<bool> persistent = persistent_species(campaign);
  std::vector<double> share(persistent.size(), 0.0);
  double total = 0;
  for (std::size_t s = 0; s < share.size(); ++s) {
    if (persistent[s]) share[s] = charge.volume_share[s];
    total += share[s];
  }
  for (std::size_t s = 0; s < share.size(); ++s) share[s] = total > 0 ? share[s] / total : charge.volume_share[s];
  return share;
}

std::vector<double> solids_fraction(const BedMesh& mesh, const BySpecies& species_volume) {
  std::vector<double> fraction(mesh.cells(), 0.0);
  for (const auto& volume : species_volume) {
    for (std::size_t c = 0; c < fraction.size(); ++c) fraction[c] += volume[c] / mesh.cell_volume[c];
  }
  return fraction;
}

}  // namespace cupola
