#include "schemas/schema_check.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <regex>
#include <set>

#include "schemas/nearest.hpp"
#include "schemas/units.hpp"

namespace cupola {
namespace {

using Json = nlohmann::ordered_json;
using Schema = nlohmann::json;

constexpr std::size_t longest_name = 100;  // std::regex recurses once a letter

/// Beyond these a quantity is a slip of the pen, and arithmetic with it leaves the range of floating-point numbers.
constexpr double least_magnitude = 1e-60, greatest_magnitude = 1e30;
constexpr double hottest = 1e5;  // K

/// Schema of a member of an object; none for an unknown key.
const Schema* member_schema(const Schema& schema, const std::string& key) {
  if (schema.contains("properties") && schema["properties"].contains(key)) return &schema["properties"][key];
  if (schema.contains("patternProperties")) {
    for (const auto& [pattern, member] : schema["patternProperties"].items()) {
      if (key.size() <= longest_name && std::regex_search(key, std::regex(pattern))) return &member;
    }
  }
  if (schema.contains("additionalProperties") && schema["additionalProperties"].is_object())
    return &schema["additionalProperties"];
  return nullptr;
}

/// Schema of an item of a list: the same for all, or one a place.
const Schema* item_schema(const Schema& schema, std::size_t place) {
  if (!schema.contains("items")) return nullptr;
  const auto& items = schema["items"];
  if (!items.is_array()) return &items;
  return place < items.size() ? &items[place] : nullptr;
}

std::vector<std::string> known_keys(const Schema& schema) {
  std::vector<std::string> keys;
  if (schema.contains("properties")) {
    for (const auto& [key, value] : schema["properties"].items()) keys.push_back(key);
  }
  return keys;
}

/// First path of the schema that ends with this key: where a key in the wrong place belongs.
std::string home_of(const Schema& schema, const std::string& key, const std::string& path) {
  if (const auto* items = item_schema(schema, 0)) return home_of(*items, key, fmt::format("{}[]", path));
  if (schema.contains("patternProperties"))
    return home_of(schema["patternProperties"].front(), key, path_of(path, "<name>"));
  if (schema.contains("additionalProperties") && schema["additionalProperties"].is_object()) {
    return home_of(schema["additionalProperties"], key, path_of(path, "<name>"));
  }
  if (!schema.contains("properties")) return "";
  if (schema["properties"].contains(key)) return path_of(path, key);
  for (const auto& [name, member] : schema["properties"].items()) {
    if (auto found = home_of(member, key, path_of(path, name)); !found.empty()) return found;
  }
  return "";
}

std::string kind_of(const Json& value) {
  if (value.is_null()) return "nothing";
  if (value.is_object()) return "a section of keys";
  if (value.is_array()) return fmt::format("a list of {}", value.size());
  if (value.is_string()) return fmt::format("`{}`", value.get<std::string>());
  return fmt::format("`{}`", value.dump());
}

std::string expected_kind(const Schema& schema) {
  if (schema.contains("enum"))
    return fmt::format("one of {}", fmt::join(schema["enum"].get<std::vector<std::string>>(), ", "));
  if (schema.contains("x-unit")) {
    auto text = describe_unit(schema["x-unit"]);
    if (schema.contains("x-words"))
      text += fmt::format(" or {}", fmt::join(schema["x-words"].get<std::vector<std::string>>(), ", "));
    if (schema.contains("items")) text += " or a table over the temperature";
    return text;
  }
  if (!schema.contains("type")) return "something else";
  const auto& type = schema["type"];
  if (type == "object") return "a section of keys";
  if (type == "array") return "a list";
  if (type == "integer") return "a whole number";
  if (type == "boolean") return "true or false";
  return "a text";
}

bool is_kind(const Json& value, const Schema& type) {
  if (type.is_array())
    return std::any_of(type.begin(), type.end(), [&](const Schema& one) { return is_kind(value, one); });
  if (type == "object") return value.is_object();
  if (type == "array") return value.is_array();
  if (type == "string") return value.is_string();
  if (type == "boolean") return value.is_boolean();
  if (type == "integer") return value.is_number_integer();
  return value.is_number();
}

class Check {
 public:
  Check(YamlDocument& document, const Schema& schema) : document_(document), schema_(schema) {}

  void run(const SchemaValidator& validator) {
    convert(document_.root, schema_, "");
    validate(validator);
  }

 private:
  void add(const std::string& path, const std::string& message) {
    document_.errors.push_back(document_.error_at(path, message));
  }
  void add_at_key(const std::string& path, const std::string& message) {
    document_.errors.push_back(document_.error_at_key(path, message));
  }

  void convert(Json& value, const Schema& schema, const std::string& path) {
    if (value.is_object()) {
      for (auto& [key, member] : value.items()) {
        if (const auto* inner = member_schema(schema, key)) convert(member, *inner, path_of(path, key));
      }
    } else if (value.is_array()) {
      for (std::size_t i = 0; i < value.size(); ++i) {
        if (const auto* inner = item_schema(schema, i)) convert(value[i], *inner, path_of(path, i));
      }
    } else if (schema.contains("x-unit")) {
      if (value.is_string()) convert_quantity(value, schema, path);
      if (value.is_number()) check_magnitude(value.get<double>(), schema["x-unit"], path);
    }
  }

  void check_magnitude(double number, const std::string& unit, const std::string& path) {
    const double greatest = unit == "K" ? hottest : greatest_magnitude;
    const double magnitude = std::abs(number);
    if (number == 0 || (magnitude >= least_magnitude && magnitude <= greatest)) return;
    add(path, fmt::format("{} {} cannot be meant: quantities are 0, or from {:.0e} to {:.0e} {} in magnitude", number,
                          unit, least_magnitude, greatest, unit));
    failed_.insert(path);
  }

  void convert_quantity(Json& value, const Schema& schema, const std::string& path) {
    const auto text = value.get<std::string>();
    const auto words = schema.value("x-words", std::vector<std::string>{});
    if (std::find(words.begin(), words.end(), text) != words.end()) return;
    try {
      const double number = to_si(text, schema["x-unit"]);
      const bool whole = schema["type"][0] == "integer";
      if (whole && number != static_cast<double>(static_cast<int>(std::clamp(number, -1e9, 1e9)))) {
        throw UnitError(fmt::format("expected a whole number, but `{}` stands here", text));
      }
      value = whole ? Json(static_cast<int>(number)) : Json(number);
    } catch (const UnitError& error) {
      add(path, error.what() + (words.empty() ? "" : fmt::format(" (or {})", fmt::join(words, ", "))));
      failed_.insert(path);
    }
  }

  /// valijson says where the document breaks the schema; the words are ours.
  void validate(const SchemaValidator& validator) {
    const auto breaks = validator.breaks(Schema(document_.root));
    std::set<std::vector<std::string>> places;
    const auto before = document_.errors.size();
    for (const auto& one : breaks) {
      if (places.insert(one.path).second) explain(one.path);
    }
    if (!breaks.empty() && document_.errors.size() == before && failed_.empty())
      add("", fmt::format("the file breaks the schema: {}", breaks.front().description));
  }

  void explain(const std::vector<std::string>& keys) {
    const Schema* schema = &schema_;
    const Json* value = &document_.root;
    std::string path;
    for (const auto& key : keys) {
      if (value->is_array()) {
        const auto index = std::stoul(key);
        schema = item_schema(*schema, index);
        value = &value->at(index);
        path = path_of(path, index);
      } else {
        schema = member_schema(*schema, key);
        value = &value->at(key);
        path = path_of(path, key);
      }
      if (schema == nullptr) return;
    }
    explain(*value, *schema, path);
  }

  void explain(const Json& value, const Schema& schema, const std::string& path) {
    if (failed_.contains(path)) return;
    if (schema.contains("enum")) {
      const auto& choices = schema["enum"];
      if (std::find(choices.begin(), choices.end(), Schema(value)) != choices.end()) return;
      const auto near =
          value.is_string() ? suggestion(value.get<std::string>(), choices.get<std::vector<std::string>>()) : "";
      add(path, fmt::format("expected {}, but {} stands here{}", expected_kind(schema), kind_of(value), near));
      return;
    }
    if (schema.contains("type") && !is_kind(value, schema["type"])) {
      const auto message = fmt::format("expected {}, but {} stands here", expected_kind(schema), kind_of(value));
      value.is_null() ? add_at_key(path, message) : add(path, message);
      return;
    }
    if (value.is_object()) explain_object(value, schema, path);
    if (value.is_array()) explain_list(value, schema, path);
    if (value.is_number()) explain_number(value.get<double>(), schema, path);
    if (value.is_string()) explain_text(value.get<std::string>(), schema, path);
  }

  void explain_object(const Json& value, const Schema& schema, const std::string& path) {
    const auto known = known_keys(schema);
    std::set<std::string> misspelt;
    for (const auto& [key, member] : value.items()) {
      if (member_schema(schema, key) != nullptr) continue;
      if (schema.contains("patternProperties")) {
        add_at_key(path_of(path, key),
                   fmt::format("the name `{}` must begin with a letter and hold only letters, digits and _", key));
        continue;
      }
      auto hint = suggestion(key, known);
      if (const auto near = nearest_word(key, known)) misspelt.insert(*near);
      if (hint.empty()) {
        const auto home = home_of(schema_, key, "");
        hint = home.empty() ? fmt::format(" (known here: {})", fmt::join(known, ", "))
                            : fmt::format(" (it belongs at `{}`)", home);
      }
      add_at_key(path_of(path, key), fmt::format("unknown key `{}`{}", key, hint));
    }
    for (const auto& key : schema.value("required", std::vector<std::string>{})) {
      if (value.contains(key) || misspelt.contains(key)) continue;
      add_at_key(path,
                 fmt::format("the key `{}` is missing: expected {}", key, expected_kind(schema["properties"][key])));
    }
    if (!misspelt.empty()) return;
    const auto least = schema.value("minProperties", std::size_t{0});
    const auto most = schema.value("maxProperties", value.size());
    const auto what = known.empty() ? "keys" : fmt::format("{}", fmt::join(known, ", "));
    if (value.size() < least) add(path, fmt::format("expected at least {} of: {}", least, what));
    if (value.size() > most) add(path, fmt::format("expected at most {} of: {}", most, what));
  }

  void explain_list(const Json& value, const Schema& schema, const std::string& path) {
    const auto least = schema.value("minItems", std::size_t{0});
    const auto most = schema.value("maxItems", value.size());
    const auto refuse = [&](const char* bound, std::size_t wanted) {
      add(path, fmt::format("expected a list of {}{}, but it has {} ({})", bound, wanted, value.size(),
                            schema.value("description", "")));
    };
    if (value.size() < least) refuse(least == most ? "" : "at least ", least);
    if (value.size() > most) refuse(least == most ? "" : "at most ", most);
  }

  void explain_number(double value, const Schema& schema, const std::string& path) {
    const auto unit = schema.value("x-unit", "1");
    const auto broken = [&](const char* keyword, const char* words, auto breaks) {
      if (schema.contains(keyword) && breaks(schema[keyword].get<double>())) {
        add(path, fmt::format("must be {} {}, but is {}{}", words, schema[keyword].get<double>(), value,
                              unit == "1" ? "" : " " + unit));
      }
    };
    broken("minimum", "at least", [&](double limit) { return value < limit; });
    broken("maximum", "at most", [&](double limit) { return value > limit; });
    broken("exclusiveMinimum", "greater than", [&](double limit) { return value <= limit; });
    broken("exclusiveMaximum", "less than", [&](double limit) { return value >= limit; });
  }

  void explain_text(const std::string& value, const Schema& schema, const std::string& path) {
    if (schema.contains("maxLength") && value.size() > schema["maxLength"].get<std::size_t>()) {
      add(path, fmt::format("must have at most {} letters", schema["maxLength"].get<std::size_t>()));
    } else if (schema.contains("pattern")) {
      add(path, fmt::format("`{}` is no name here: it must match {}", value, schema["pattern"].get<std::string>()));
    }
  }

  YamlDocument& document_;
  const Schema& schema_;
  std::set<std::string> failed_;  ///< paths already reported
};

}  // namespace

void check_against_schema(YamlDocument& document, const SchemaValidator& validator) {
  Check(document, validator.schema()).run(validator);
}

}  // namespace cupola
