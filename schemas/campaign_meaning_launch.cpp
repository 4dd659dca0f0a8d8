#include <algorithm>
#include <array>
#include <string_view>

#include "schemas/campaign_meaning.hpp"

namespace cupola::meaning {
namespace {

/// Options of sbatch that other keys or cupola itself set.
constexpr std::array<std::pair<std::string_view, std::string_view>, 16> taken{
    {{"--account", "launch.slurm.account"},
     {"--chdir", "cupola"},
     {"--dependency", "cupola"},
     {"--error", "cupola"},
     {"--job-name", "cupola"},
     {"--nodes", "launch.slurm.nodes"},
     {"--no-requeue", "cupola"},
     {"--ntasks", "launch.slurm.ranks"},
     {"--open-mode", "cupola"},
     {"--output", "cupola"},
     {"--parsable", "cupola"},
     {"--partition", "launch.slurm.partition"},
     {"--qos", "launch.slurm.qos"},
     {"--requeue", "cupola"},
     {"--signal", "launch.slurm.checkpoint_before"},
     {"--time", "launch.slurm.time"}}};

}  // namespace

void check_launch(Context& context) {
  const auto& launch = context.campaign.launch;
  if (!launch.slurm) return;
  if (launch.slurm->checkpoint_before >= launch.slurm->time) {
    context.add("launch.slurm.checkpoint_before", "{} s before the limit is before the job begins: its limit is {} s",
                launch.slurm->checkpoint_before, launch.slurm->time);
  }
  for (std::size_t i = 0; i < launch.slurm->options.size(); ++i) {
    const std::string& option = launch.slurm->options[i];
    const auto name = option.substr(0, option.find('='));
    const auto* const found =
        std::find_if(taken.begin(), taken.end(), [&](const auto& entry) { return entry.first == name; });
    if (found == taken.end()) continue;
    const auto path = path_of("launch.slurm.options", i);
    if (found->second == "cupola")
      context.add(path, "cupola sets {} itself: leave it out", name);
    else
      context.add(path, "{} is set by `{}`: use that", name, found->second);
  }
}

}  // namespace cupola::meaning
