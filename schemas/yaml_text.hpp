#pragma once
#include <nlohmann/json.hpp>
#include <string>

namespace cupola {

/// A JSON value as block-style YAML that reads back to the last bit: numbers in their shortest exact form, texts
/// quoted.
std::string yaml_text(const nlohmann::ordered_json& value);

}  // namespace cupola
