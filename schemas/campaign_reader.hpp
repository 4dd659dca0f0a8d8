#pragma once
#include <filesystem>
#include <string>
#include <vector>

#include "schemas/campaign.hpp"

namespace cupola {

/// One thing wrong with a campaign file.
struct CampaignError {
  std::string file;
  int line = 0;         ///< from 1
  int column = 0;       ///< from 1
  std::string key;      ///< path of the key, dots and [index]: `scene.gas.inlets[0].mass_flow`
  std::string message;  ///< what was expected, what stands there, and the nearest known key for a misspelt one
};

/// Result of reading: either a campaign, or all errors of the file at once.
struct ReadCampaign {
  Campaign campaign;  ///< valid only without errors
  std::vector<CampaignError> errors;
  [[nodiscard]] bool ok() const { return errors.empty(); }
};

/// Reads, checks against the JSON Schema, converts units, fills defaults and checks for meaning.
/// @throws Failure input_output where the file cannot be read
ReadCampaign read_campaign(const std::filesystem::path& file);
ReadCampaign read_campaign_text(const std::string& text, const std::string& file_name);

/// Like read_campaign, all errors joined into one Failure (wrong_input).
Campaign load_campaign(const std::filesystem::path& file);

/// All errors, one a line: `file:line:column: key: message`.
std::string to_text(const std::vector<CampaignError>& errors);

/// The JSON Schema of the campaign file, as published in schemas/campaign.schema.json.
const std::string& campaign_schema();

}  // namespace cupola
