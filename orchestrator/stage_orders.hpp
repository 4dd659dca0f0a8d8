#pragma once
#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "orchestrator/episode_fields.hpp"
#include "schemas/task.hpp"

namespace cupola {

/// What a stage is to be run with.
struct StageOrder {
  std::map<std::string, std::filesystem::path> inputs;  ///< files by the names of `Task::inputs`
  std::optional<double> tracer_duration{};              ///< s, instead of the campaign's
};

/// What the stages of an episode are made from, by the campaign's strategy (docs/running.md).
///
/// `march`: DEM stage k gets the packing of DEM stage k-1 and the temperatures of tracer stage k-1; tracer stage k the
/// granular field of DEM stage k and the same temperatures.
///
/// `predict-and-verify`: DEM stage k softens by the corrected prediction of the episode before, the first by the first
/// prediction; a prediction with its field follows, corrected by what was measured before; tracers that begin with it
/// are marched some layer passages, and what they do corrects it.  Where a prediction did not succeed, the tracers
/// march `tracer.duration` instead and their temperatures are what goes on.
///
/// @param before finished episodes, oldest first  @param now those of this episode that have ended
/// @return none: the stage is left out
std::optional<StageOrder> stage_order(TaskKind kind, const std::vector<EpisodeFolders>& before,
                                      const EpisodeFolders& now, const std::filesystem::path& run,
                                      const Campaign& campaign);

/// What the DEM stage of the last of these episodes softened and melted by; empty: a guess.
std::filesystem::path softened_by(const std::vector<EpisodeFolders>& episodes, const std::filesystem::path& run);

}  // namespace cupola
