#pragma once
#include <memory>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

namespace cupola {

/// A JSON Schema made ready for many documents.
class SchemaValidator {
 public:
  explicit SchemaValidator(nlohmann::json schema);
  ~SchemaValidator();
  SchemaValidator(const SchemaValidator&) = delete;
  SchemaValidator& operator=(const SchemaValidator&) = delete;
  SchemaValidator(SchemaValidator&&) = delete;
  SchemaValidator& operator=(SchemaValidator&&) = delete;

  [[nodiscard]] const nlohmann::json& schema() const;

  /// One place where a document breaks the schema.
  struct Break {
    std::vector<std::string> path;  ///< keys and indices from the root, each once, as they are
    std::string description;        ///< the library's words
  };
  /// All of them; none where the document fits.
  [[nodiscard]] std::vector<Break> breaks(const nlohmann::json& document) const;

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace cupola
