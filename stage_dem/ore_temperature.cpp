#include "stage_dem/ore_temperature.hpp"

#include <algorithm>

#include "physics/closures/guessed_zone.hpp"
#include "schemas/field_file.hpp"

namespace cupola {

OreTemperature::OreTemperature(const Campaign& campaign)
    : zone_(campaign.initial.cohesive_zone), charge_(campaign.charging.temperature) {}

OreTemperature::OreTemperature(const Task& task, const std::filesystem::path& task_folder, const BedMesh& mesh)
    : OreTemperature(task.campaign) {
  if (const auto input = task.inputs.find("solids_temperature"); input != task.inputs.end()) {
    const FieldFile before(task_folder / input->second.file, "tracer-result", mesh.hash);
    if (before.has_cell_data("ore_temperature")) ore_ = before.cell_data("ore_temperature");
    if (before.has_cell_data("gas_temperature")) gas_ = before.cell_data("gas_temperature");
  }
  if (!gas_.empty() || !task.campaign.scene.gas) return;
  double hottest = charge_;
  for (const auto& inlet : task.campaign.scene.gas->inlets) hottest = std::max(hottest, inlet.total_temperature);
  gas_.resize(mesh.cells());
  for (std::size_t cell = 0; cell < mesh.cells(); ++cell) gas_[cell] = std::min(hottest, guess(mesh.cell_centre[cell]));
}

double OreTemperature::at(const Vector3& position, std::int64_t cell) const {
  if (ore_.empty()) return guess(position);
  return cell < 0 ? charge_ : ore_[static_cast<std::size_t>(cell)];
}

double OreTemperature::guess(const Vector3& position) const {
  return zone_ ? guessed_temperature(*zone_, position) : charge_;
}

}  // namespace cupola
