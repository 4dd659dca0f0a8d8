#pragma once
#include <string>
#include <vector>

#include "schemas/campaign.hpp"
#include "schemas/task.hpp"

namespace cupola {

/// `dem`, `tracer`, `predict` or `correct`: the folder of a stage in an episode, and its name in the journal.
std::string stage_name(TaskKind kind);
/// Its kind again. @throws std::out_of_range
TaskKind stage_kind(const std::string& name);
/// `dem stage of episode 2`, `prediction of episode 2`, `first prediction`
std::string stage_title(TaskKind kind, int episode);

/// Episode of the prediction that a campaign begins with.
inline constexpr int before_all_episodes = 0;

/// Can a campaign go on marching without it?  So it can without predictions and corrections.
bool can_be_left_out(TaskKind kind);

/// The stages of an episode, in their order.
const std::vector<TaskKind>& stages_of_episode(Strategy strategy);
/// Every kind of stage that an episode can have, in their order.
const std::vector<TaskKind>& all_stages_of_episode();

}  // namespace cupola
