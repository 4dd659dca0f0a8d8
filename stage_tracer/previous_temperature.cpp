#include "stage_tracer/previous_temperature.hpp"

#include "physics/closures/guessed_zone.hpp"
#include "schemas/field_file.hpp"

namespace cupola {
namespace {

/// Temperatures that tracers begin with, and what the bed held then.
void begin_with(PreviousTemperature& previous, const FieldFile& file, const Campaign& campaign) {
  for (const Species& species : campaign.species)
    previous.by_species.push_back(file.cell_data("solids_temperature." + species.name));
  const nlohmann::json summary = file.summary();
  if (summary.contains("energy_in_bed")) previous.energy = summary["energy_in_bed"].get<double>();
}

}  // namespace

PreviousTemperature read_previous_temperature(const std::filesystem::path& folder, const Task& task,
                                              const BedMesh& mesh) {
  PreviousTemperature previous;
  const Campaign& campaign = task.campaign;
  if (!campaign.heat) return previous;
  const auto prediction = task.inputs.find("prediction");
  if (prediction != task.inputs.end())
    begin_with(previous, FieldFile(folder / prediction->second.file, "tracer-result", mesh.hash), campaign);
  const auto input = task.inputs.find("solids_temperature");
  if (input == task.inputs.end()) {
    previous.ore.assign(mesh.cells(), campaign.charging.temperature);
    if (const auto& guess = campaign.initial.cohesive_zone) {
      for (std::size_t c = 0; c < mesh.cells(); ++c) previous.ore[c] = guessed_temperature(*guess, mesh.cell_centre[c]);
    }
    return previous;
  }
  const FieldFile file(folder / input->second.file, "tracer-result", mesh.hash);
  previous.ore =
      file.has_cell_data("ore_temperature") ? file.cell_data("ore_temperature") : file.cell_data("solids_temperature");
  if (prediction == task.inputs.end()) begin_with(previous, file, campaign);
  return previous;
}

void set_temperatures(Tracers& tracers, const PreviousTemperature& previous, const Campaign& campaign,
                      const PathField& paths) {
  tracers.temperature.resize(tracers.size());
  for (std::size_t i = 0; i < tracers.size(); ++i) {
    if (!previous.by_species.empty()) {
      tracers.temperature[i] = previous.by_species[tracers.species[i]][tracers.point[i].cell];
    } else if (const auto& guess = campaign.initial.cohesive_zone) {
      tracers.temperature[i] = guessed_temperature(*guess, paths.position(tracers.point[i]));
    } else {
      tracers.temperature[i] = campaign.charging.temperature;
    }
  }
}

}  // namespace cupola
