#pragma once
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

#include "schemas/campaign.hpp"

namespace cupola {

/// How many more episodes a campaign takes, as far as its changes tell.
struct RemainingEpisodes {
  int episodes = 0;          ///< after those that have been judged
  bool until_limit = false;  ///< the trend leads beyond the limit: this many are left until there
  std::string why;           ///< the rule that takes longest, or why nothing better is known
};

/// Extrapolates the judgements of the episodes so far: a rule's remaining change over its criterion, c, shrinks by the
/// contraction factor lambda an episode (by the ratio of its last two changes where a rule has no lambda), so it is met
/// after n = ln c / -ln lambda more episodes (at least 0); all rules must then hold for `converged.for` episodes on
/// end.  lambda counts as at least 0.3, as in the convergence rules.
/// @param judged the journal's `episode-judged` records, oldest first @param at_most the limit in force
/// @return none before two episodes have been judged
std::optional<RemainingEpisodes> remaining_episodes(const std::vector<nlohmann::json>& judged,
                                                    const Converged& converged, int at_most);

}  // namespace cupola
