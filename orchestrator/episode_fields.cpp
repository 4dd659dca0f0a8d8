#include "orchestrator/episode_fields.hpp"

#include <algorithm>

#include "schemas/field_file.hpp"
#include "schemas/hdf.hpp"

namespace cupola {
namespace {

/// sum over species of share x density x heat capacity.
std::vector<double> mixture_heat_capacity(const FieldFile& tracer, const Campaign& campaign) {
  std::vector<double> sum(tracer.cells(), 0.);
  for (const Species& species : campaign.species) {
    const std::vector<double> share = tracer.cell_data("volume_share." + species.name);
    const std::vector<double> temperature = tracer.cell_data("solids_temperature." + species.name);
    for (std::size_t cell = 0; cell < sum.size(); ++cell)
      sum[cell] += share[cell] * species.density * species.heat_capacity.at(temperature[cell]);
  }
  return sum;
}

}  // namespace

bool has_cohesive_zone(const Campaign& campaign) {
  return campaign.heat && std::any_of(campaign.species.begin(), campaign.species.end(),
                                      [](const Species& species) { return species.softening.has_value(); });
}

EpisodeFields read_episode_fields(const EpisodeFolders& folders, const Campaign& campaign) {
  const FieldFile tracer(folders.tracer / "result.hdf", "tracer-result");
  const FieldFile dem(folders.dem / "result.hdf", "dem-result", tracer.header().mesh_hash);
  const HdfReader mesh(folders.tracer / "foam" / "mesh.hdf");
  EpisodeFields fields;
  fields.cell_volume = mesh.doubles("Mesh/cell_volume", static_cast<std::int64_t>(tracer.cells()));
  fields.solids_fraction = tracer.cell_data("solids_fraction");
  fields.stagnant = tracer.cell_data("stagnant");
  fields.solids_velocity = tracer.cell_data("solids_velocity", 3);
  fields.tracer_summary = tracer.summary();
  fields.velocity_error = dem.cell_data("solids_velocity_error", 3);
  const double scale = fields.tracer_summary.value("scale", 0.);
  for (double& error : fields.velocity_error) error *= scale;
  if (campaign.heat) {
    fields.heat_capacity = mixture_heat_capacity(tracer, campaign);
    fields.temperature = tracer.cell_data("solids_temperature");
  }
  if (has_cohesive_zone(campaign)) {
    fields.zone_height = tracer.hdf().doubles("CohesiveZone/height_melted");
    fields.zone_area = tracer.hdf().doubles("CohesiveZone/area", static_cast<std::int64_t>(fields.zone_height.size()));
  }
  return fields;
}

}  // namespace cupola
