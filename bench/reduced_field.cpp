#include "bench/reduced_field.hpp"

#include <algorithm>
#include <cmath>
#include <map>

#include "physics/closures/guessed_zone.hpp"
#include "schemas/failure.hpp"
#include "schemas/field_file.hpp"

namespace cupola::bench {
namespace {

constexpr double zero = 293;  // K, enthalpies and norms count from it

double left_edge(const Campaign& campaign) {
  double widest = 0;
  for (const auto& row : campaign.scene.geometry.profile) widest = std::max(widest, row[1]);
  return -widest;
}

void require_like(const ReducedField& field, const ReducedField& reference) {
  if (field.across != reference.across || field.up != reference.up || field.box != reference.box)
    throw Failure(ExitCode::wrong_input, "the reference is of another furnace; make it again");
}

}  // namespace

ReducedField ReducedField::of_result(const std::filesystem::path& result, const Campaign& campaign) {
  const FieldFile file(result, "tracer-result");
  const auto species = file.hdf().integers("Tracers/species");
  const auto position = file.hdf().doubles("Tracers/position");
  const auto volume = file.hdf().doubles("Tracers/volume");
  const auto temperature = file.hdf().doubles("Tracers/temperature");
  ReducedField field;
  const double left = left_edge(campaign);
  field.across = static_cast<std::size_t>(std::ceil(-2 * left / field.box));
  field.up = static_cast<std::size_t>(std::ceil((campaign.top() - campaign.bottom()) / field.box));
  field.capacity.assign(field.across * field.up, 0.0);
  field.temperature.assign(field.across * field.up, 0.0);
  for (std::size_t i = 0; i < species.size(); ++i) {
    const auto column = static_cast<std::size_t>((position[3 * i] - left) / field.box);
    const auto row = static_cast<std::size_t>((position[3 * i + 2] - campaign.bottom()) / field.box);
    const std::size_t place = std::min(row, field.up - 1) * field.across + std::min(column, field.across - 1);
    const Species& kind = campaign.species[static_cast<std::size_t>(species[i])];
    const double capacity = volume[i] * kind.density * kind.heat_capacity.at(temperature[i]);
    field.capacity[place] += capacity;
    field.temperature[place] += capacity * temperature[i];
  }
  for (std::size_t i = 0; i < field.capacity.size(); ++i)
    field.temperature[i] = field.capacity[i] > 0 ? field.temperature[i] / field.capacity[i] : zero;

  std::map<double, std::pair<double, int>> zone;  // by x: heights over the depth
  if (file.hdf().has("CohesiveZone/x")) {
    const auto x = file.hdf().doubles("CohesiveZone/x");
    const auto height = file.hdf().doubles("CohesiveZone/height_melted");
    for (std::size_t i = 0; i < x.size(); ++i) {
      if (!std::isfinite(height[i])) continue;
      auto& [sum, count] = zone[std::round(x[i] * 1e6) * 1e-6];
      sum += height[i];
      ++count;
    }
  }
  for (const auto& [x, mean] : zone) {
    field.zone_x.push_back(x);
    field.zone_height.push_back(mean.first / mean.second);
  }
  return field;
}

ReducedField ReducedField::of_json(const nlohmann::json& json) {
  ReducedField field;
  json.at("box").get_to(field.box);
  json.at("across").get_to(field.across);
  json.at("up").get_to(field.up);
  json.at("capacity").get_to(field.capacity);
  json.at("temperature").get_to(field.temperature);
  json.at("zone_x").get_to(field.zone_x);
  json.at("zone_height").get_to(field.zone_height);
  return field;
}

nlohmann::json ReducedField::to_json() const {
  // Rounded to what the comparison can tell.
  const auto rounded = [](const std::vector<double>& values, double unit) {
    std::vector<double> result;
    for (const double value : values) result.push_back(std::round(value / unit) * unit);
    return result;
  };
  return {{"box", box},
          {"across", across},
          {"up", up},
          {"capacity", rounded(capacity, 1)},
          {"temperature", rounded(temperature, 0.015625)},
          {"zone_x", zone_x},
          {"zone_height", rounded(zone_height, 0.0009765625)}};
}

double temperature_error(const ReducedField& field, const ReducedField& reference) {
  require_like(field, reference);
  double square = 0;
  double norm = 0;
  for (std::size_t i = 0; i < reference.capacity.size(); ++i) {
    if (field.capacity[i] <= 0) continue;
    square += reference.capacity[i] * std::pow(field.temperature[i] - reference.temperature[i], 2);
    norm += reference.capacity[i] * std::pow(reference.temperature[i] - zero, 2);
  }
  return std::sqrt(square / norm);
}

double zone_error(const ReducedField& field, const ReducedField& reference) {
  double sum = 0;
  int count = 0;
  for (std::size_t i = 0; i < reference.zone_x.size(); ++i) {
    for (std::size_t j = 0; j < field.zone_x.size(); ++j) {
      if (std::abs(field.zone_x[j] - reference.zone_x[i]) > 1e-4) continue;
      sum += std::abs(field.zone_height[j] - reference.zone_height[i]);
      ++count;
    }
  }
  return count > 0 ? sum / count : NAN;
}

double change_from_guess(const ReducedField& reference, const Campaign& campaign) {
  double square = 0;
  double norm = 0;
  for (std::size_t i = 0; i < reference.capacity.size(); ++i) {
    const double x = left_edge(campaign) + (static_cast<double>(i % reference.across) + 0.5) * reference.box;
    const double z = campaign.bottom() + (static_cast<double>(i / reference.across) + 0.5) * reference.box;
    const double begin = guessed_temperature(*campaign.initial.cohesive_zone, {x, 0, z});
    square += reference.capacity[i] * std::pow(begin - reference.temperature[i], 2);
    norm += reference.capacity[i] * std::pow(reference.temperature[i] - zero, 2);
  }
  return std::sqrt(square / norm);
}

}  // namespace cupola::bench
