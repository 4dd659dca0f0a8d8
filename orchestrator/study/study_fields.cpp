#include "orchestrator/study/study_fields.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "orchestrator/study/study_blocks.hpp"
#include "physics/closures/enthalpy_zero.hpp"
#include "schemas/field_file.hpp"

namespace cupola {
namespace {

using nlohmann::json;

constexpr double least_solids = 0.05;  // volume fraction below which there is no bed
constexpr double nan_value = std::numeric_limits<double>::quiet_NaN();

/// Mean pressure of the inlets above the outlet's, Pa.
std::optional<double> pressure_drop(const json& inlets, const Campaign& campaign) {
  if (!inlets.is_array() || inlets.empty() || !campaign.scene.gas) return std::nullopt;
  double sum = 0;
  for (const json& inlet : inlets) sum += inlet.at("pressure").get<double>() - campaign.scene.gas->outlet_pressure;
  return sum / static_cast<double>(inlets.size());
}

/// rms of `values - others` over that of `others - offset`, weighted; both with `columns` values a cell.
std::optional<double> relative_rms(const std::vector<double>& values, const std::vector<double>& others,
                                   const std::vector<double>& weights, std::size_t columns, double offset) {
  double difference = 0, size = 0;
  for (std::size_t i = 0; i < weights.size(); ++i) {
    if (weights[i] <= 0) continue;
    for (std::size_t c = 0; c < columns; ++c) {
      const double other = others[columns * i + c];
      difference += weights[i] * std::pow(values[columns * i + c] - other, 2);
      size += weights[i] * std::pow(other - offset, 2);
    }
  }
  if (size <= 0) return std::nullopt;
  return std::sqrt(difference / size);
}

std::optional<double> field_error(const StudyFields& fields, const StudyFields& reference,
                                  std::vector<double> StudyFields::*field, std::size_t columns, double offset) {
  const std::vector<double>&here = fields.*field, &there = reference.*field;
  if (here.empty() || there.empty()) return std::nullopt;
  if (fields.mesh_hash == reference.mesh_hash) {
    std::vector<double> weights = reference.solids_volume;
    for (std::size_t i = 0; i < weights.size(); ++i)
      if (fields.solids_volume[i] <= 0) weights[i] = 0;
    return relative_rms(here, there, weights, columns, offset);
  }
  const StudyBlocks blocks(fields, reference);
  const BlockMeans ours = blocks.means(fields, here, columns), theirs = blocks.means(reference, there, columns);
  std::vector<double> weights = theirs.weight;
  for (std::size_t i = 0; i < weights.size(); ++i)
    if (ours.weight[i] <= 0) weights[i] = 0;
  return relative_rms(ours.value, theirs.value, weights, columns, offset);
}

/// Mean over the depth of columns with the same x.
struct Outline {
  std::vector<double> x, area, height;
};

Outline outline_of(const StudyFields& fields) {
  std::map<long, std::array<double, 4>> by_x;  // micrometres -> x, area, area with zone, area x height
  for (std::size_t i = 0; i < fields.zone_x.size(); ++i) {
    auto& sums = by_x[std::lround(fields.zone_x[i] * 1e6)];
    sums[0] = fields.zone_x[i];
    sums[1] += fields.zone_area[i];
    if (!std::isfinite(fields.zone_height[i])) continue;
    sums[2] += fields.zone_area[i];
    sums[3] += fields.zone_area[i] * fields.zone_height[i];
  }
  Outline outline;
  for (const auto& [key, sums] : by_x) {
    outline.x.push_back(sums[0]);
    outline.area.push_back(sums[1]);
    outline.height.push_back(sums[2] > 0 ? sums[3] / sums[2] : nan_value);
  }
  return outline;
}

/// Height at x, linear between columns; NaN where one of them has no zone.
double height_at(const Outline& outline, double x) {
  const auto right = std::lower_bound(outline.x.begin(), outline.x.end(), x);
  const auto i = static_cast<std::size_t>(right - outline.x.begin());
  if (i == 0) return outline.height.front();
  if (i == outline.x.size()) return outline.height.back();
  const double share = (x - outline.x[i - 1]) / (outline.x[i] - outline.x[i - 1]);
  return (1 - share) * outline.height[i - 1] + share * outline.height[i];
}

/// rms difference of heights; one that only one side has counts as moved from or to the lowest height found.
std::optional<double> height_rms(const std::vector<double>& ours, const std::vector<double>& theirs,
                                 const std::vector<double>& area) {
  double lowest = std::numeric_limits<double>::infinity();
  for (const auto* heights : {&ours, &theirs})
    for (const double height : *heights)
      if (std::isfinite(height)) lowest = std::min(lowest, height);
  if (!std::isfinite(lowest)) return std::nullopt;
  double sum = 0, total = 0;
  for (std::size_t i = 0; i < area.size(); ++i) {
    if (!std::isfinite(ours[i]) && !std::isfinite(theirs[i])) continue;
    const double here = std::isfinite(ours[i]) ? ours[i] : lowest,
                 there = std::isfinite(theirs[i]) ? theirs[i] : lowest;
    sum += area[i] * std::pow(here - there, 2);
    total += area[i];
  }
  return std::sqrt(sum / total);
}

std::optional<double> zone_error(const StudyFields& fields, const StudyFields& reference) {
  if (fields.zone_x.empty() || reference.zone_x.empty()) return std::nullopt;
  if (fields.zone_x == reference.zone_x) return height_rms(fields.zone_height, reference.zone_height, fields.zone_area);
  const Outline ours = outline_of(fields), theirs = outline_of(reference);
  const Outline& coarser = ours.x.size() < theirs.x.size() ? ours : theirs;
  std::vector<double> here, there;
  for (const double x : coarser.x) {
    here.push_back(height_at(ours, x));
    there.push_back(height_at(theirs, x));
  }
  return height_rms(here, there, coarser.area);
}

std::optional<double> mean_height(const StudyFields& fields) {
  double sum = 0, area = 0;
  for (std::size_t i = 0; i < fields.zone_x.size(); ++i)
    if (std::isfinite(fields.zone_height[i])) {
      sum += fields.zone_area[i] * fields.zone_height[i];
      area += fields.zone_area[i];
    }
  return area > 0 ? std::optional(sum / area) : std::nullopt;
}

/// Value of a field at (x, z): that of the bed's nearest cell, mean over the depth where several are as near.
double value_at(const StudyFields& fields, const std::vector<double>& centres, double x, double z,
                const std::function<double(std::size_t)>& value) {
  constexpr double as_near = 1e-6;  // m
  double nearest = std::numeric_limits<double>::infinity(), sum = 0;
  int count = 0;
  for (std::size_t cell = 0; cell < fields.solids_volume.size(); ++cell) {
    if (fields.solids_volume[cell] <= 0) continue;
    const double distance = std::hypot(centres[3 * cell] - x, centres[3 * cell + 2] - z);
    if (distance < nearest - as_near) {
      nearest = distance;
      sum = 0;
      count = 0;
    }
    if (distance < nearest + as_near) {
      sum += value(cell);
      ++count;
    }
  }
  return count > 0 ? sum / count : nan_value;
}

std::optional<double> points_error(const StudyFields& fields, const DataTable& data, double offset,
                                   const std::function<double(std::size_t)>& value) {
  const std::vector<double>&x = data.columns.at("x"), &z = data.columns.at("z"), &wanted = data.columns.at("value");
  const std::vector<double> centres = cell_centres(fields);
  std::vector<double> found;
  for (std::size_t i = 0; i < x.size(); ++i) found.push_back(value_at(fields, centres, x[i], z[i], value));
  return relative_rms(found, wanted, std::vector<double>(x.size(), 1.), 1, offset);
}

}  // namespace

StudyFields read_study_fields(const std::filesystem::path& task_folder, TaskKind kind, const Campaign& campaign) {
  const bool tracer = kind == TaskKind::tracer;
  const FieldFile file(task_folder / "result.hdf", tracer ? "tracer-result" : "dem-result");
  const HdfReader mesh(task_folder / "foam" / "mesh.hdf");
  const json summary = file.summary();
  StudyFields fields;
  fields.mesh_hash = file.header().mesh_hash;
  fields.points = file.points();
  fields.cell_points = file.cell_points();
  fields.cell_volume = mesh.doubles("Mesh/cell_volume", static_cast<std::int64_t>(file.cells()));
  fields.velocity = file.cell_data("solids_velocity", 3);
  fields.solids_volume = file.cell_data("solids_fraction");
  const std::vector<double> stagnant = tracer ? file.cell_data("stagnant") : std::vector<double>(file.cells(), 0.);
  for (std::size_t cell = 0; cell < file.cells(); ++cell) {
    const bool bed = fields.solids_volume[cell] > least_solids && stagnant[cell] < 0.5;
    fields.solids_volume[cell] *= bed ? fields.cell_volume[cell] : 0;
  }
  fields.pressure_drop =
      pressure_drop(summary.value(json::json_pointer(tracer ? "/inlets" : "/gas/inlets"), json::array()), campaign);
  if (!tracer || !campaign.heat) return fields;
  fields.temperature = file.cell_data("solids_temperature");
  if (summary.contains("top_gas_temperature") && summary["top_gas_temperature"].is_number())
    fields.top_gas_temperature = summary["top_gas_temperature"].get<double>();
  if (file.hdf().has("CohesiveZone/x")) {
    fields.zone_x = file.hdf().doubles("CohesiveZone/x");
    fields.zone_area = file.hdf().doubles("CohesiveZone/area");
    fields.zone_height = file.hdf().doubles("CohesiveZone/height_melted");
  }
  return fields;
}

std::optional<double> metric_figure(StudyMetric metric, const StudyFields& fields) {
  double sum = 0, volume = 0;
  for (std::size_t cell = 0; cell < fields.solids_volume.size(); ++cell) {
    const double weight = fields.solids_volume[cell];
    volume += weight;
    if (metric == StudyMetric::temperature && !fields.temperature.empty()) sum += weight * fields.temperature[cell];
    if (metric == StudyMetric::descent)
      for (std::size_t c = 0; c < 3; ++c) sum += weight * std::pow(fields.velocity[3 * cell + c], 2);
  }
  switch (metric) {
    case StudyMetric::temperature:
      return fields.temperature.empty() || volume <= 0 ? std::nullopt : std::optional(sum / volume);
    case StudyMetric::cohesive_zone:
      return mean_height(fields);
    case StudyMetric::descent:
      return volume > 0 ? std::optional(std::sqrt(sum / volume)) : std::nullopt;
    case StudyMetric::pressure_drop:
      return fields.pressure_drop;
    case StudyMetric::top_gas_temperature:
      return fields.top_gas_temperature;
  }
  return std::nullopt;
}

std::optional<double> metric_error(StudyMetric metric, const StudyFields& fields, const StudyFields& reference) {
  switch (metric) {
    case StudyMetric::temperature:
      return field_error(fields, reference, &StudyFields::temperature, 1, enthalpy_zero);
    case StudyMetric::cohesive_zone:
      return zone_error(fields, reference);
    case StudyMetric::descent:
      return field_error(fields, reference, &StudyFields::velocity, 3, 0);
    default:
      const auto number = metric_figure(metric, reference);
      return number ? metric_error(metric, fields, *number) : std::nullopt;
  }
}

std::optional<double> metric_error(StudyMetric metric, const StudyFields& fields, double number) {
  const auto own = metric_figure(metric, fields);
  if (!own) return std::nullopt;
  if (metric == StudyMetric::pressure_drop) return std::abs(*own - number) / std::abs(number);
  return std::abs(*own - number);
}

std::optional<double> metric_error(StudyMetric metric, const StudyFields& fields, const DataTable& data) {
  switch (metric) {
    case StudyMetric::temperature:
      if (fields.temperature.empty()) return std::nullopt;
      return points_error(fields, data, enthalpy_zero, [&](std::size_t cell) { return fields.temperature[cell]; });
    case StudyMetric::descent:
      return points_error(fields, data, 0, [&](std::size_t cell) { return -fields.velocity[3 * cell + 2]; });
    case StudyMetric::cohesive_zone: {
      if (fields.zone_x.empty()) return std::nullopt;
      const Outline outline = outline_of(fields);
      std::vector<double> here;
      for (const double x : data.columns.at("x")) here.push_back(height_at(outline, x));
      return height_rms(here, data.columns.at("value"), std::vector<double>(here.size(), 1.));
    }
    default:
      return metric_error(metric, fields, data.columns.at("value").front());
  }
}

std::vector<std::string> data_columns(StudyMetric metric) {
  if (metric == StudyMetric::temperature || metric == StudyMetric::descent) return {"x", "z", "value"};
  if (metric == StudyMetric::cohesive_zone) return {"x", "value"};
  return {"value"};
}

}  // namespace cupola
