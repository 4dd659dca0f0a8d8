#pragma once
#include <filesystem>
#include <nlohmann/json.hpp>
#include <optional>
#include <vector>

#include "schemas/campaign.hpp"

namespace cupola {

/// The finished task folders of an episode.
struct EpisodeFolders {
  std::filesystem::path dem;
  std::filesystem::path tracer;
  std::optional<std::filesystem::path> predict{};  ///< with `predict-and-verify`, where it succeeded
  std::optional<std::filesystem::path> correct{};
};

/// What the convergence rules look at in one episode, read from its results. Cells in undecomposed order, SI.
struct EpisodeFields {
  std::vector<double> cell_volume;      ///< m3
  std::vector<double> solids_fraction;  ///< cleaned
  std::vector<double> stagnant;         ///< 1 where the bed stands still
  std::vector<double> solids_velocity;  ///< m/s, cleaned and scaled to the descent rate, three a cell
  std::vector<double> velocity_error;   ///< m/s, standard error of the measured field at the same scale, three a cell
  std::vector<double> heat_capacity;    ///< J/m3/K of the solids' own volume; empty without heat
  std::vector<double> temperature;      ///< K; empty without heat
  std::vector<double> zone_height;      ///< m by column, NaN where there is none; empty where nothing melts
  std::vector<double> zone_area;        ///< m2 by column
  nlohmann::json tracer_summary;
};

/// @throws Failure where a result is damaged or lacks what the contract promises
EpisodeFields read_episode_fields(const EpisodeFolders& folders, const Campaign& campaign);

/// Whether a softening species is heated: only then there is a cohesive zone to judge.
bool has_cohesive_zone(const Campaign& campaign);

}  // namespace cupola
