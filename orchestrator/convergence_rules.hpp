#pragma once
#include <optional>
#include <string>
#include <vector>

#include "orchestrator/convergence.hpp"
#include "orchestrator/episode_fields.hpp"
#include "schemas/campaign.hpp"

namespace cupola {

/// The last episodes, newest last: two or three.
using EpisodeWindow = std::vector<EpisodeFields>;

/// One criterion of `converged:`.  To add one: a function here, and its line in `convergence_rules()`.
struct ConvergenceRule {
  std::string name;  ///< key in `converged:` and in `change` of report.json
  bool (*applies)(const Campaign&);
  Judgement (*judge)(const EpisodeWindow&, const Campaign&);
};

/// Every rule there is.
const std::vector<ConvergenceRule>& convergence_rules();

/// Share of the charge that left the tracer stage as unmelted ore.
double unmelted_share(const EpisodeFields& fields);

/// Cells that count in the norms: their solids' volume, m3; 0 where the bed stands still in any of the episodes.
std::vector<double> moving_solids_volume(const EpisodeWindow& window);

}  // namespace cupola
