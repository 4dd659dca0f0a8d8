#include <fmt/format.h>

#include "orchestrator/commands.hpp"
#include "orchestrator/measured_rates.hpp"
#include "physics/plan/plan.hpp"
#include "schemas/campaign_reader.hpp"

namespace cupola {

ExitCode explain(const std::filesystem::path& campaign_file, bool as_json) {
  const Plan plan = make_plan(load_campaign(campaign_file), measured_rates());
  fmt::print("{}\n", as_json ? plan_json(plan).dump(2) : plan_text(plan));
  return plan.refusals.empty() ? ExitCode::done : ExitCode::wrong_input;
}

}  // namespace cupola
