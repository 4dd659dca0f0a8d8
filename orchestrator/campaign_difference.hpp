#pragma once
#include <string>
#include <vector>

#include "schemas/campaign.hpp"

namespace cupola {

/// The keys in which two campaigns differ, as sentences: `tracer.duration: 18000 there, 3600 here`.
/// @param there, here campaigns as `resolved_yaml` writes them
std::vector<std::string> changed_keys(const std::string& there, const std::string& here);

/// The campaign with one key set to another value, checked like any campaign file.
/// @param key path with dots, as in the campaign file: `dem.time_step`
/// @throws Failure wrong_input where the key is unknown or the value does not fit it
Campaign with_changed_key(const Campaign& campaign, const std::string& key, const std::string& value);

}  // namespace cupola
