#pragma once
#include <filesystem>
#include <nlohmann/json.hpp>
#include <vector>

#include "orchestrator/episode_fields.hpp"
#include "schemas/campaign.hpp"

namespace cupola {

/// The estimate of the remaining error is this many times what was measured: on prototypes the last jump alone was 1.5
/// times smaller than the error.
inline constexpr double remaining_error_safety = 1.5;

/// Judges an episode with a corrected prediction.  All are rms of temperatures over rms(T - 293 K):
/// * `jump`: corrected prediction against the one that the episode's DEM stage softened by; what another DEM field
/// changes, and how well two measurements agree,
/// * `to_go`: what the marched tracers had still to go by the tendency they showed,
/// * `noise`: standard error of the march's means,
/// * `left_alone`: how far the tracers went from the prediction they began with, beyond that noise.
/// The remaining error is estimated as `remaining_error_safety` sqrt(jump^2 + to_go^2 + noise^2); `left_alone` must be
/// below the criterion too.
/// @param episodes all so far, oldest first, the last with a correction
/// @param softened_by what its DEM stage softened by; empty: a guess
/// @return content of the journal's line `episode-judged` as of `judge_episode`, with `remaining_error` besides
nlohmann::json judge_prediction(const std::vector<EpisodeFolders>& episodes, const std::filesystem::path& softened_by,
                                const Campaign& campaign);

/// Whether a judgement is one of these, so that one episode that meets all is enough: its march has verified it.
bool is_verified(const nlohmann::json& judgement);

}  // namespace cupola
