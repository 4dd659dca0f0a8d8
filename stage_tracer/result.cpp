#include "stage_tracer/result.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "physics/gas/inlets_json.hpp"
#include "schemas/campaign_words.hpp"
#include "schemas/field_file.hpp"
#include "stage_tracer/bed_composition.hpp"
#include "stage_tracer/ore_temperature.hpp"

namespace cupola {
namespace {

// A species counts as present in a cell where it fills more than this part of the bed's solids.
constexpr double least_presence = 0.02;

std::vector<double> flat(const std::vector<Vector3>& vectors) {
  std::vector<double> rows;
  rows.reserve(3 * vectors.size());
  for (const Vector3& v : vectors) rows.insert(rows.end(), v.begin(), v.end());
  return rows;
}

std::vector<double> capacity_weights(const Campaign& campaign, const BySpecies& volume, const BySpecies& temperature,
                                     std::size_t species) {
  std::vector<double> weight = volume[species];
  const Species& material = campaign.species[species];
  for (std::size_t c = 0; c < weight.size(); ++c)
    weight[c] *= material.density * material.heat_capacity.at(temperature[species][c]);
  return weight;
}

/// Mean over all solids, and each species' own where present, else the mean, else `fallback`.
struct SolidsTemperature {
  std::vector<double> all;
  BySpecies by_species;
};

SolidsTemperature solids_temperature(const Campaign& campaign, const BySpecies& volume, const BySpecies& temperature,
                                     const std::vector<double>& fallback) {
  const std::size_t cells = fallback.size();
  SolidsTemperature result{std::vector<double>(cells, 0.0), temperature};
  std::vector<double> capacity(cells, 0.0);
  for (std::size_t s = 0; s < volume.size(); ++s) {
    const std::vector<double> weight = capacity_weights(campaign, volume, temperature, s);
    for (std::size_t c = 0; c < cells; ++c) {
      capacity[c] += weight[c];
      result.all[c] += weight[c] * temperature[s][c];
    }
  }
  for (std::size_t c = 0; c < cells; ++c) result.all[c] = capacity[c] > 0 ? result.all[c] / capacity[c] : fallback[c];
  for (std::size_t s = 0; s < volume.size(); ++s) {
    for (std::size_t c = 0; c < cells; ++c) {
      if (!(volume[s][c] > 0)) result.by_species[s][c] = result.all[c];
    }
  }
  return result;
}

/// Mean velocity of the solids in each cell from the face fluxes: sum of flux x (face centre - cell centre) over the
/// cell's volume, exact for a uniform field, over the storage.
std::vector<Vector3> cell_velocity(const BedMesh& mesh, const GranularField& field) {
  std::vector<Vector3> velocity(mesh.cells(), Vector3{});
  for (std::size_t f = 0; f < mesh.faces(); ++f) {
    const auto add = [&](std::int64_t cell, double outflow) {
      for (std::size_t k = 0; k < 3; ++k)
        velocity[cell][k] += outflow * (mesh.face_centre[f][k] - mesh.cell_centre[cell][k]);
    };
    add(mesh.face_owner[f], field.face_flux[f]);
    if (f < mesh.internal_faces()) add(mesh.face_neighbour[f], -field.face_flux[f]);
  }
  for (std::size_t c = 0; c < mesh.cells(); ++c) {
    for (double& component : velocity[c]) component /= mesh.cell_volume[c] * field.storage[c];
  }
  return velocity;
}

nlohmann::json isotherm_json(const Isotherm& isotherm) {
  const auto number = [](double value) {
    return std::isfinite(value) ? nlohmann::json(value) : nlohmann::json(nullptr);
  };
  return {{"height_mean", number(isotherm.height_mean)},
          {"height_min", number(isotherm.height_min)},
          {"height_max", number(isotherm.height_max)},
          {"columns_without", isotherm.columns_without}};
}

const Softening& softening_of(const Campaign& campaign) {
  const Softening* softening = nullptr;
  for (const Species& species : campaign.species) {
    if (species.softening) softening = &*species.softening;
  }
  return *softening;
}

/// Another ore temperature, made monotone; its isotherms are looked for anew.
void replace(MeltingZone& zone, const BedMesh& mesh, const Campaign& campaign, const std::vector<double>& by) {
  for (const Column& column : zone.columns) {
    std::vector<double> values;
    for (const std::int64_t cell : column.cells) values.push_back(std::max(by[cell], campaign.charging.temperature));
    values = isotonic(values, std::vector<double>(values.size(), 1.0));
    for (std::size_t i = 0; i < values.size(); ++i) zone.ore_temperature[column.cells[i]] = values[i];
  }
  const Softening& softening = softening_of(campaign);
  zone.melted = find_isotherm(mesh, zone.columns, zone.ore_temperature, softening.melted);
  zone.softened = find_isotherm(mesh, zone.columns, zone.ore_temperature, softening.from);
}

void write_temperatures(FieldFileWriter& file, const Task& task, const MarchOutcome& outcome, nlohmann::json& summary) {
  const Campaign& campaign = task.campaign;
  const BySpecies volume = outcome.averages.volume();
  const BySpecies temperature = outcome.averages.temperature();
  const std::vector<double> fallback = outcome.gas != nullptr
                                           ? outcome.gas->temperature()
                                           : std::vector<double>(outcome.mesh.cells(), campaign.charging.temperature);
  const SolidsTemperature solids = solids_temperature(campaign, volume, temperature, fallback);
  file.cell_data("solids_temperature", solids.all);
  for (std::size_t s = 0; s < campaign.species.size(); ++s) {
    file.cell_data("solids_temperature." + campaign.species[s].name, solids.by_species[s]);
  }
  summary["mean_solid_temperature"] = outcome.averages.mean_solid_temperature();
  summary["energy_in_bed"] = outcome.ledger.energy_now;
  if (!can_melt(campaign)) return;
  MeltingZone zone = find_melting_zone(outcome.mesh, campaign, outcome.field, volume, temperature);
  if (!outcome.ore_temperature.empty()) replace(zone, outcome.mesh, campaign, outcome.ore_temperature);
  file.cell_data("ore_temperature", zone.ore_temperature);
  std::vector<double> x;
  std::vector<double> area;
  for (const Column& column : zone.columns) {
    x.push_back(column.x);
    area.push_back(column.area);
  }
  file.hdf().write("CohesiveZone/x", x);
  file.hdf().write("CohesiveZone/area", area);
  file.hdf().write("CohesiveZone/height_melted", zone.melted.height);
  file.hdf().write("CohesiveZone/height_softened", zone.softened.height);
  summary["cohesive_zone"] = isotherm_json(zone.melted);
  summary["softening_zone"] = isotherm_json(zone.softened);
}

void write_gas(FieldFileWriter& file, const Campaign& campaign, const GasModel& gas, nlohmann::json& summary) {
  file.cell_data("gas_pressure", gas.flow().pressure());
  file.cell_data("gas_mass_flux", flat(gas.flow().mass_flux()), 3);
  file.cell_data("gas_inertia_over_drag", gas.flow().inertia_over_drag());
  summary["gas_model"] = std::string(words::word_of(words::tracer_gas, campaign.tracer.gas));
  summary["flow_solves"] = gas.flow_solves();
  summary["flow_skips"] = gas.flow_skips();
  summary["energy_solves"] = gas.energy_solves();
  summary["inertia_over_drag_largest"] = gas.flow().inertia_over_drag_largest();
  summary["inlets"] = inlets_json(gas.flow().inlets());
  if (!campaign.heat) return;
  file.cell_data("gas_temperature", gas.temperature());
  summary["top_gas_temperature"] = gas.energy_ledger().top_gas_temperature;
}

void write_tracers(HdfWriter& hdf, const MarchOutcome& outcome, bool heat) {
  std::vector<std::int64_t> id;
  std::vector<std::int64_t> species;
  std::vector<double> volume;
  std::vector<double> temperature;
  for (std::size_t r = 0; r < outcome.tracer_rows.size(); r += tracer_columns) {
    id.push_back(static_cast<std::int64_t>(outcome.tracer_rows[r]));
    species.push_back(static_cast<std::int64_t>(outcome.tracer_rows[r + 1]));
    volume.push_back(outcome.tracer_rows[r + 6]);
    temperature.push_back(outcome.tracer_rows[r + 8]);
  }
  hdf.write("Tracers/id", id);
  hdf.write("Tracers/species", species);
  hdf.write("Tracers/position", flat(outcome.tracer_position), 3);
  hdf.write("Tracers/volume", volume);
  if (heat) hdf.write("Tracers/temperature", temperature);
}

}  // namespace

bool can_melt(const Campaign& campaign) {
  return campaign.heat && std::any_of(campaign.species.begin(), campaign.species.end(),
                                      [](const Species& s) { return s.softening.has_value(); });
}

MeltingZone find_melting_zone(const BedMesh& mesh, const Campaign& campaign, const GranularField& field,
                              const BySpecies& volume, const BySpecies& temperature) {
  std::vector<double> weight(mesh.cells(), 0.0);
  std::vector<double> mean(mesh.cells(), 0.0);
  std::vector<double> least(mesh.cells(), 0.0);
  const Softening* softening = nullptr;
  for (std::size_t s = 0; s < volume.size(); ++s) {
    if (!campaign.species[s].softening) continue;
    softening = &*campaign.species[s].softening;
    for (std::size_t c = 0; c < mesh.cells(); ++c) {
      weight[c] += volume[s][c];
      mean[c] += volume[s][c] * temperature[s][c];
    }
  }
  if (softening == nullptr) throw std::logic_error("a melting zone was asked for without a species that softens");
  for (std::size_t c = 0; c < mesh.cells(); ++c) {
    if (weight[c] > 0) mean[c] /= weight[c];
    least[c] = least_presence * std::max(field.solids_fraction[c], least_solids_fraction) * mesh.cell_volume[c];
  }
  MeltingZone zone;
  zone.columns = mesh_columns(mesh, field.bed);
  zone.ore_temperature =
      continue_ore_temperature(mesh, zone.columns, mean, weight, least, *softening, campaign.charging.temperature);
  zone.melted = find_isotherm(mesh, zone.columns, zone.ore_temperature, softening->melted);
  zone.softened = find_isotherm(mesh, zone.columns, zone.ore_temperature, softening->from);
  return zone;
}

void write_result(const std::filesystem::path& folder, const Task& task, const MarchOutcome& outcome) {
  const Campaign& campaign = task.campaign;
  const BedMesh& mesh = outcome.mesh;
  std::vector<std::int64_t> cell_points;
  for (const auto& cell : mesh.cell_points) cell_points.insert(cell_points.end(), cell.begin(), cell.end());
  FieldFileWriter file(folder / "result.hdf", {"tracer-result", task.campaign_hash, mesh.hash}, flat(mesh.points),
                       cell_points);
  const bool heat = campaign.heat.has_value();

  nlohmann::json summary = {
      {"tracers", outcome.tracers},
      {"cells", mesh.cells()},
      {"ranks", outcome.ranks},
      {"process_seconds", outcome.process_seconds},
      {"wall_seconds", outcome.wall_seconds},
      {"wall_seconds_by_part", outcome.wall_seconds_by_part},
      {"imbalance", {{"motion", outcome.motion_imbalance}}},
      {"time_step", outcome.time_step},
      {"steps", outcome.steps},
      {"flow_solves", 0},
      {"energy_solves", 0},
      {"scale", outcome.field.scale},
      {"scale_check", outcome.field.scale_check},
      {"storage_over_removal", outcome.field.storage_over_removal},
      {"field_cleaning",
       {{"error_before", outcome.field.error_before},
        {"error_after", outcome.field.error_after},
        {"change", outcome.field.change}}},
      {"stagnant_cells", std::count(outcome.field.stagnant.begin(), outcome.field.stagnant.end(), true)},
      {"layer_passage", outcome.field.charge.recipe_time},
      {"averaged_seconds", outcome.averages.seconds()},
      {"ledger", outcome.ledger.to_json(heat)},
      {"clamps", {{"void_fraction_cells", outcome.cells_at_floor}}}};

  if (outcome.step_error)
    summary["accuracy"] = {{"asked", campaign.tracer.accuracy}, {"time_step_error", *outcome.step_error}};
  if (outcome.until_steady) {
    summary["steady"] = {{"asked", campaign.tracer.remaining_change},
                         {"reached", outcome.process_seconds < campaign.tracer.longest() * (1 - 1e-9)},
                         {"remaining_change", nullptr},
                         {"windows", outcome.windows}};
    if (outcome.remaining) {
      summary["steady"]["remaining_change"] = outcome.remaining->change;
      summary["steady"]["ratio"] = outcome.remaining->ratio;
    }
  }
  if (outcome.held_back) summary["displacements_held_back"] = *outcome.held_back;

  const BySpecies volume = outcome.averages.volume();
  const BySpecies share = volume_shares({volume, {}}, share_of_persistent(campaign, outcome.field.charge));
  for (std::size_t s = 0; s < campaign.species.size(); ++s)
    file.cell_data("volume_share." + campaign.species[s].name, share[s]);
  file.cell_data("solids_fraction", outcome.field.solids_fraction);
  file.cell_data("solids_velocity", flat(cell_velocity(mesh, outcome.field)), 3);
  file.cell_data("stagnant", std::vector<double>(outcome.field.stagnant.begin(), outcome.field.stagnant.end()));
  if (outcome.gas != nullptr) write_gas(file, campaign, *outcome.gas, summary);
  if (!outcome.gas_comparison.is_null()) summary["gas_models"] = outcome.gas_comparison;
  if (heat) {
    summary["intragrain_resistance"] = campaign.heat->intragrain_resistance;
    for (std::size_t s = 0; s < outcome.largest_biot.size(); ++s)
      summary["biot_largest"][campaign.species[s].name] = outcome.largest_biot[s];
  }
  if (heat) write_temperatures(file, task, outcome, summary);
  for (const auto& [name, values] : outcome.more_cell_data) file.cell_data(name, values);
  if (!outcome.prediction.is_null()) summary["prediction"] = outcome.prediction;
  if (!outcome.correction.is_null()) summary["correction"] = outcome.correction;
  if (outcome.measured != nullptr) outcome.measured->write(file.hdf());
  write_tracers(file.hdf(), outcome, heat);
  file.summary(summary);
  file.commit();
}

}  // namespace cupola
