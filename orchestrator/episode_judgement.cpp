#include "orchestrator/episode_judgement.hpp"

#include <algorithm>
#include <cmath>

#include "orchestrator/convergence_rules.hpp"

namespace cupola {
namespace {

using nlohmann::json;

/// JSON has no infinity: a change without bound is not known.
json number(double value) { return std::isfinite(value) ? json(value) : json(nullptr); }

}  // namespace

json judge_episode(const std::vector<EpisodeFolders>& episodes, const Campaign& campaign) {
  constexpr std::size_t looked_at = 3;
  EpisodeWindow window;
  for (auto folders = episodes.end() - static_cast<long>(std::min(episodes.size(), looked_at));
       folders != episodes.end(); ++folders)
    window.push_back(read_episode_fields(*folders, campaign));
  json change = json::object(), figure = json::object(), lambda = json::object();
  bool met = window.size() > 1;
  for (const ConvergenceRule& rule : convergence_rules()) {
    change[rule.name] = figure[rule.name] = lambda[rule.name] = nullptr;
    if (window.size() < 2 || !rule.applies(campaign)) continue;
    const Judgement judgement = rule.judge(window, campaign);
    change[rule.name] = number(judgement.change);
    figure[rule.name] = number(judgement.figure);
    if (judgement.lambda) lambda[rule.name] = number(*judgement.lambda);
    met = met && judgement.met;
  }
  return {{"episode", episodes.size()}, {"change", change}, {"figure", figure},
          {"lambda", lambda},           {"met", met},       {"unmelted_share", unmelted_share(window.back())}};
}

}  // namespace cupola
