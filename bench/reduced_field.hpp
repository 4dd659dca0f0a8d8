#pragma once
#include <filesystem>
#include <nlohmann/json.hpp>
#include <vector>

#include "schemas/campaign.hpp"

namespace cupola::bench {

/// The end of a march in little: temperature of the solids in boxes of the x-z plane, and the height of the cohesive
/// zone over x.  Small enough to be kept with the sources.
struct ReducedField {
  double box = 0.25;                        ///< m, edge
  std::size_t across = 0, up = 0;           ///< boxes
  std::vector<double> capacity;             ///< J/K, [up][across]
  std::vector<double> temperature;          ///< K, heat-capacity weighted mean; 293 in empty boxes
  std::vector<double> zone_x, zone_height;  ///< m, mean over the depth; a column without a zone is left out

  /// From `result.hdf` of a task. @throws Failure
  static ReducedField of_result(const std::filesystem::path& result, const Campaign& campaign);
  static ReducedField of_json(const nlohmann::json& json);
  [[nodiscard]] nlohmann::json to_json() const;
};

/// rms(T - T_ref)/rms(T_ref - 293 K), weighted with the reference's heat capacities.
double temperature_error(const ReducedField& field, const ReducedField& reference);
/// Mean distance of the cohesive zones where both have one, m.
double zone_error(const ReducedField& field, const ReducedField& reference);
/// rms(T_ref - T_begin)/rms(T_ref - 293 K) with the guessed temperatures that a march begins from.
double change_from_guess(const ReducedField& reference, const Campaign& campaign);

}  // namespace cupola::bench
