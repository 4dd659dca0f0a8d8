#pragma once
#include "schemas/yaml_document.hpp"

namespace cupola {

/// Fills a campaign from a document that check_against_schema has gone over, defaults and derived values included. What
/// is missing or of the wrong kind (reported already) becomes NaN or stays empty, so that the checks for meaning pass
/// over it.
Campaign campaign_from_document(const YamlDocument& document);

/// Checks for meaning: contradictions between keys that each are well formed.  Appends to `document.errors`.
void check_meaning(const Campaign& campaign, YamlDocument& document);

/// Document to campaign: schema, defaults, meaning.  Used for campaign files and for the campaign inside a task.
ReadCampaign read_campaign_document(YamlDocument document);

}  // namespace cupola
