#include "schemas/schema_validator.hpp"

#include <valijson/adapters/nlohmann_json_adapter.hpp>
#include <valijson/schema.hpp>
#include <valijson/schema_parser.hpp>
#include <valijson/validator.hpp>

// Nothing but valijson's templates stands in this file, which costs a compiler more than all of the reader: see
// CMakeLists.txt.
namespace cupola {

struct SchemaValidator::State {
  nlohmann::json text;
  valijson::Schema compiled;
};

SchemaValidator::SchemaValidator(nlohmann::json schema) : state_(std::make_unique<State>()) {
  state_->text = std::move(schema);
  const valijson::adapters::NlohmannJsonAdapter adapter(state_->text);
  valijson::SchemaParser().populateSchema(adapter, state_->compiled);
}

SchemaValidator::~SchemaValidator() = default;

const nlohmann::json& SchemaValidator::schema() const { return state_->text; }

std::vector<SchemaValidator::Break> SchemaValidator::breaks(const nlohmann::json& document) const {
  valijson::Validator validator(valijson::Validator::kStrongTypes);
  valijson::ValidationResults results;
  const valijson::adapters::NlohmannJsonAdapter target(document);
  std::vector<Break> found;
  if (validator.validate(state_->compiled, target, &results)) return found;
  for (const auto& result : results) {
    Break one{{}, result.description};
    // The first is the root; the others are `[key]`.
    for (std::size_t i = 1; i < result.context.size(); ++i)
      one.path.push_back(result.context[i].substr(1, result.context[i].size() - 2));
    found.push_back(std::move(one));
  }
  return found;
}

}  // namespace cupola
