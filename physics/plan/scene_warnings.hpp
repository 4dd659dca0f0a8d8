#pragma once
#include <string>
#include <vector>

#include "schemas/campaign.hpp"

namespace cupola {

/// What a campaign asks for that can be computed but is likely not what was meant: a drag law far outside its range, a
/// species of which the bed will hold nothing.  Known before anything is run; the report repeats it.
/// @throws Failure wrong_input as `charge_of` and `expected_parcels`
std::vector<std::string> scene_warnings(const Campaign& campaign);

}  // namespace cupola
