#include "schemas/yaml_text.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace cupola {
namespace {

using Json = nlohmann::ordered_json;

bool is_flat(const Json& value) {
  return value.empty() ||
         (value.is_array() && std::none_of(value.begin(), value.end(), [](const Json& v) { return v.is_object(); }));
}

/// A number, text or list of them in one line.
std::string flow(const Json& value) {
  if (value.is_number_float()) return fmt::format("{}", value.get<double>());
  if (!value.is_array() || value.empty()) return value.dump();
  std::string text = "[";
  for (const auto& item : value) {
    if (text.size() > 1) text += ", ";
    text += flow(item);
  }
  text += "]";
  return text;
}

bool needs_no_quotes(const std::string& key) {
  return !key.empty() && std::all_of(key.begin(), key.end(), [](char c) { return (c >= 'a' && c <= 'z') || c == '_'; });
}

void write(std::string& text, const Json& value, int indent);

/// Value after `key:` or `-`.
void write_after(std::string& text, const Json& value, int indent) {
  if (!value.is_structured() || is_flat(value)) {
    text += " " + flow(value) + "\n";
  } else {
    text += "\n";
    write(text, value, indent);
  }
}

void write(std::string& text, const Json& value, int indent) {
  const std::string margin(static_cast<std::size_t>(indent), ' ');
  if (value.is_object()) {
    for (const auto& [key, member] : value.items()) {
      text += margin + (needs_no_quotes(key) ? key : Json(key).dump()) + ":";
      write_after(text, member, indent + 2);
    }
  } else {
    for (const auto& item : value) {
      text += margin + "-";
      write_after(text, item, indent + 2);
    }
  }
}

}  // namespace

std::string yaml_text(const Json& value) {
  std::string text;
  write(text, value, 0);
  return text;
}

}  // namespace cupola
