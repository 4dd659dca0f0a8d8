#pragma once
#include <nlohmann/json.hpp>

#include "schemas/schema_validator.hpp"
#include "schemas/yaml_document.hpp"

namespace cupola {

/// Turns every quantity of the document (schema keyword `x-unit`) into an SI number and checks the whole against the
/// schema. What is wrong is appended to `document.errors`; a quantity that cannot be understood stays a text.
void check_against_schema(YamlDocument& document, const SchemaValidator& validator);

}  // namespace cupola
