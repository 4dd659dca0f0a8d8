#include <fmt/format.h>

#include <algorithm>

#include "orchestrator/commands.hpp"
#include "orchestrator/go_on.hpp"
#include "orchestrator/launch/slurm_chain.hpp"
#include "physics/plan/plan.hpp"
#include "schemas/campaign_reader.hpp"

namespace cupola {
namespace {

namespace fs = std::filesystem;

/// `runs/<campaign>`, with nothing in the name that would lead elsewhere.
fs::path usual_folder(const fs::path& campaign_file) {
  std::string name = load_campaign(campaign_file).name;
  std::replace(name.begin(), name.end(), '/', '-');
  if (name.empty() || name.front() == '.') name.insert(0, "run");
  return fs::path("runs") / name;
}

}  // namespace

std::unique_ptr<RunFolder> open_for(const fs::path& campaign_file, const std::optional<fs::path>& folder) {
  const Plan plan = make_plan(load_campaign(campaign_file));
  refuse(plan);
  for (const std::string& warning : plan.warnings) fmt::print("note: {}\n", warning);
  return RunFolder::for_campaign(campaign_file, folder.value_or(usual_folder(campaign_file)));
}

ExitCode run(const fs::path& campaign_file, const std::optional<fs::path>& folder, const MarchOptions& options) {
  SignalWatch signals;
  const auto opened = open_for(campaign_file, folder);
  SlurmChain(*opened).require_none();
  return go_on(*opened, options, signals);
}

ExitCode resume(const fs::path& folder, const MarchOptions& options) {
  SignalWatch signals;
  const auto opened = RunFolder::open(folder);
  SlurmChain(*opened).require_none();
  return go_on(*opened, options, signals);
}

}  // namespace cupola
