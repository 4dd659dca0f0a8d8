#pragma once
#include <nlohmann/json.hpp>
#include <string>

/// What a stage's failure says, for people.  @param failure `failure.json`, or the journal's copy of it
namespace cupola {

/// What happened and where: `two parcels overlap … (step 5205)`.
std::string what_happened(const nlohmann::json& failure);

/// The same with all that can be tried: `two parcels overlap … (step 5205). Try contacts.youngs_modulus: 1e+07 Pa or
/// dem.rayleigh_fraction: 0.0124.`
std::string failure_text(const nlohmann::json& failure);

}  // namespace cupola
