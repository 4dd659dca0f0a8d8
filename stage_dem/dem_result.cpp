#include <spdlog/spdlog.h>

#include <cmath>

#include "schemas/field_file.hpp"
#include "schemas/files.hpp"
#include "stage_dem/bed_watch.hpp"
#include "stage_dem/dem_files.hpp"
#include "stage_dem/dem_limits.hpp"
#include "stage_dem/parcels.hpp"
#include "stage_dem/part_timer.hpp"
#include "stage_dem/softening.hpp"
#include "stage_dem/stationarity.hpp"

namespace cupola {
namespace {

/// Volume-weighted mean contact fraction of the interior, NaN where the bed has none.
double interior_packing(const Campaign& campaign, const BedMesh& mesh, const std::vector<double>& contact_fraction,
                        double surface) {
  double solid = 0;
  double volume = 0;
  for (std::size_t cell = 0; cell < mesh.cells(); ++cell) {
    if (!in_interior(campaign, mesh.cell_centre[cell], surface)) continue;
    solid += contact_fraction[cell] * mesh.cell_volume[cell];
    volume += mesh.cell_volume[cell];
  }
  return volume > 0 ? solid / volume : std::numeric_limits<double>::quiet_NaN();
}

std::vector<double> flat(const std::vector<Vector3>& points) {
  std::vector<double> values;
  values.reserve(3 * points.size());
  for (const auto& point : points) values.insert(values.end(), point.begin(), point.end());
  return values;
}

}  // namespace

nlohmann::json DemFiles::summary() const {
  const DemState& state = stage_.state_;
  const Campaign& campaign = stage_.campaign_;
  const MassBooks window = stage_.books_.since(stage_.books_at_window_);
  const double seconds = stage_.averages_.seconds();
  const auto rate = [&](double mass) { return seconds > 0 ? mass / seconds : 0; };
  double coke = 0;
  std::vector<double> by_raceway;
  for (const auto& counts : window.raceways()) {
    MassBooks::Counts hard = counts;
    for (std::size_t s = 0; s < hard.size(); ++s)
      if (campaign.species[s].softening) hard[s] = 0;
    coke += window.mass(hard);
    by_raceway.push_back(rate(window.mass(counts)));
  }
  nlohmann::json summary{
      {"parcels", stage_.parcels_.size()},
      {"cells", stage_.mesh_.cells()},
      {"ranks", stage_.ranks_},
      {"process_seconds", state.time},
      {"wall_seconds", stage_.wall_seconds()},
      {"wall_seconds_by_part", state.wall_parts},
      {"time_step", stage_.step_.step},
      {"rayleigh_fraction", stage_.step_.fraction()},
      {"largest_overlap", state.largest_overlap},
      {"largest_wall_overlap", state.largest_wall_overlap},
      {"fast_parcels", state.fast_parcels},
      {"creep_speed", state.creep_speed},
      {"relaxation_seconds", state.relaxed_after},
      {"creep_over_descent", creep_over_descent(campaign, state.creep_speed)},
      {"coke_removal_rate", rate(coke)},
      {"removal_by_raceway", by_raceway},
      {"ore_melted_rate", rate(window.mass(window.melted()))},
      {"ore_unmelted_rate", rate(window.mass(window.unmelted()))},
      {"charge_rate", rate(window.mass(window.charged()))},
      {"layer_passages", layer_passages()},
      {"starved_seconds", stage_.raceways_.starved_seconds()},
      {"window_seconds", seconds},
      {"blocks", stage_.averages_.batches()},
      {"stock_height", state.stock_height},
      {"ledger", stage_.books_.ledger(stage_.parcels_)},
  };
  if (const double drifted = drift(state.descent); std::isfinite(drifted)) summary["drift"] = drifted;
  if (stage_.gas_) {
    summary["momentum_residual"] = stage_.gas_->momentum_residual();
    summary["gas"] = stage_.gas_->summary();
  }
  return summary;
}

double DemFiles::layer_passages() const {
  double recipe = 0;
  for (const Layer& layer : stage_.campaign_.charging.layers)
    for (const auto& [name, mass] : layer) recipe += mass;
  const MassBooks window = stage_.books_.since(stage_.books_at_window_);
  return recipe > 0 ? window.mass(window.charged()) / recipe : 0;
}

void DemFiles::write_packing(HdfWriter& file) const {
  const auto& parcels = stage_.parcels_;
  const auto& falling = stage_.charging_.state().falling;
  std::vector<std::int64_t> id, species, released;
  std::vector<double> position, velocity, angular_velocity, radius, mass, factor;
  for (const auto& parcel : parcels) {
    id.push_back(parcel.id);
    species.push_back(parcel.species);
    released.push_back(falling.contains(parcel.id) ? 0 : 1);
    position.insert(position.end(), parcel.position.begin(), parcel.position.end());
    velocity.insert(velocity.end(), parcel.velocity.begin(), parcel.velocity.end());
    angular_velocity.insert(angular_velocity.end(), parcel.angular_velocity.begin(), parcel.angular_velocity.end());
    radius.push_back(parcel.radius);
    mass.push_back(parcel.mass);
    factor.push_back(present_factor(stage_.campaign_, parcel));
  }
  file.write("Packing/id", id);
  file.write("Packing/species", species);
  file.write("Packing/position", position, 3);
  file.write("Packing/velocity", velocity, 3);
  file.write("Packing/angular_velocity", angular_velocity, 3);
  file.write("Packing/radius", radius);
  file.write("Packing/mass", mass);
  file.write("Packing/volume_factor", factor);
  file.write("Packing/released", released);
  const ChargingState& charging = stage_.charging_.state();
  std::vector<double> owed, carried;
  for (std::size_t s = 0; s < charging.owed.size(); ++s) {
    const double one = parcel_mass(stage_.campaign_.species[s]);
    owed.push_back(static_cast<double>(charging.owed[s]) * one);
    carried.push_back(charging.carried[s] / one);
  }
  file.write("Charging/next_layer", std::vector<std::int64_t>{charging.next_layer});
  file.write("Charging/owed", owed);
  file.write("Charging/carried", carried);
}

void DemFiles::write_result() {
  const PartTimer timer(stage_.state_.wall_parts, "result");
  if (stage_.rank_ != 0) return;
  const BedMesh& mesh = stage_.mesh_;
  const auto fields = stage_.averages_.fields();
  std::vector<std::int64_t> corners;
  for (const auto& cell : mesh.cell_points) corners.insert(corners.end(), cell.begin(), cell.end());
  FieldFileWriter file(stage_.folder_ / "result.hdf", {"dem-result", stage_.task_.campaign_hash, mesh.hash},
                       flat(mesh.points), corners);
  file.cell_data("solids_fraction", fields.fraction);
  file.cell_data("solids_fraction_error", fields.fraction_error);
  file.cell_data("solids_growth", fields.fraction_growth);
  file.cell_data("contact_fraction", fields.contact_fraction);
  file.cell_data("solids_velocity", fields.velocity, 3);
  file.cell_data("solids_velocity_error", fields.velocity_error, 3);
  const bool averaged = layer_passages() >= 2 && !stage_.species_averages_.empty();
  for (std::size_t s = 0; s < stage_.campaign_.species.size(); ++s) {
    const std::string& species = stage_.campaign_.species[s].name;
    if (averaged) {
      const auto own = stage_.species_averages_[s].fields();
      file.cell_data("solids_fraction." + species, own.fraction);
      file.cell_data("solids_fraction_error." + species, own.fraction_error);
      file.cell_data("solids_velocity." + species, own.velocity, 3);
      file.cell_data("solids_velocity_error." + species, own.velocity_error, 3);
      continue;
    }
    std::vector<double> fraction = stage_.solids_.species_volume()[s];
    for (std::size_t cell = 0; cell < fraction.size(); ++cell) fraction[cell] /= mesh.cell_volume[cell];
    file.cell_data("solids_fraction." + species, fraction);
  }
  if (stage_.gas_) {
    file.cell_data("gas_pressure", stage_.gas_->pressure());
    file.cell_data("gas_velocity", stage_.gas_->velocity(), 3);
  }
  write_packing(file.hdf());
  nlohmann::json numbers = summary();
  numbers["packing_fraction"] =
      interior_packing(stage_.campaign_, mesh, fields.contact_fraction, stage_.state_.stock_height);
  file.summary(numbers);
  file.commit();
  write_manifest(stage_.folder_);
  spdlog::info("done: {}", numbers.dump());
}

}  // namespace cupola
