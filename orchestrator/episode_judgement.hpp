#pragma once
#include <nlohmann/json.hpp>
#include <vector>

#include "orchestrator/episode_fields.hpp"
#include "schemas/campaign.hpp"

namespace cupola {

/// Judges the last of these episodes (all so far, oldest first).
/// @return content of the journal's line `episode-judged`: `change`, `figure`, `lambda` by rule (null where not known,
/// all of `change` in the first episode), `met` (all rules), `unmelted_share`
nlohmann::json judge_episode(const std::vector<EpisodeFolders>& episodes, const Campaign& campaign);

}  // namespace cupola
