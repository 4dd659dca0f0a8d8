#pragma once
#include <string>

#include "schemas/campaign.hpp"

namespace cupola {

/// The campaign as YAML with every default and derived value spelt out, SI numbers, same keys as the campaign file.
/// Reading it back with `read_campaign_text` gives the same campaign to the last bit.
std::string resolved_yaml(const Campaign& campaign);

}  // namespace cupola
