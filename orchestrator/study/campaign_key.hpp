#pragma once
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

namespace cupola {

/// A key of a campaign written as a path: `tracer.time_step`, `scene.gas.inlets[0].mass_flow`, and
/// `raceways[*].dem_removal_rate` for every member of a list.
class CampaignKey {
 public:
  /// Looks the path up in the campaign's JSON Schema and in the scene.
  /// @param scene the campaign file's root
  /// @throws std::invalid_argument with a sentence: which step is unknown, with the nearest known one; that the scene
  /// has no such species, or not so many members of a list
  CampaignKey(const std::string& path, const nlohmann::ordered_json& scene);

  [[nodiscard]] const std::string& path() const { return path_; }
  /// SI unit of the value (`1` for a plain number); empty where the key holds no quantity.
  [[nodiscard]] const std::string& unit() const { return unit_; }
  /// Puts a value there; sections on the way are made.
  void set(nlohmann::ordered_json& campaign, const nlohmann::ordered_json& value) const;
  /// The value as the campaign reads it: a text with a unit as an SI number. What cannot be understood stays as it is.
  [[nodiscard]] nlohmann::ordered_json in_si(const nlohmann::ordered_json& value) const;

 private:
  std::string path_, unit_;
  std::vector<std::string> steps_;  ///< names; `[3]`, `[*]` of lists
};

}  // namespace cupola
