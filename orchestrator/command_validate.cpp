#include <fmt/format.h>

#include <nlohmann/json.hpp>

#include "orchestrator/commands.hpp"
#include "schemas/campaign_reader.hpp"

namespace cupola {

ExitCode validate(const std::filesystem::path& campaign_file, bool as_json) {
  const ReadCampaign read = read_campaign(campaign_file);
  if (as_json) {
    nlohmann::json errors = nlohmann::json::array();
    for (const CampaignError& error : read.errors)
      errors.push_back({{"file", error.file},
                        {"line", error.line},
                        {"column", error.column},
                        {"key", error.key},
                        {"message", error.message}});
    fmt::print("{}\n", nlohmann::json{{"ok", read.ok()}, {"errors", errors}}.dump(2));
  } else if (read.ok()) {
    fmt::print("{}: campaign \"{}\" is valid\n", campaign_file.string(), read.campaign.name);
  } else {
    throw Failure(ExitCode::wrong_input, to_text(read.errors));
  }
  return read.ok() ? ExitCode::done : ExitCode::wrong_input;
}

}  // namespace cupola
