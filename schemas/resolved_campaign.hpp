#pragma once
#include <nlohmann/json.hpp>
#include <string>

#include "schemas/campaign.hpp"

namespace cupola {

/// The campaign as YAML with every default and derived value spelt out, SI numbers, same keys as the campaign file.
/// Reading it back with `read_campaign_text` gives the same campaign to the last bit.
std::string resolved_yaml(const Campaign& campaign);

/// The same as a JSON value, keys in the order of the campaign file.
nlohmann::ordered_json resolved_json(const Campaign& campaign);

}  // namespace cupola
