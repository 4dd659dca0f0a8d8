#include "orchestrator/failure_text.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <vector>

namespace cupola {
namespace {

using nlohmann::json;

std::string text_of(const json& value) { return value.is_string() ? value.get<std::string>() : value.dump(); }

/// Name and value of every entry of an object of the failure, as `format` has them.
std::vector<std::string> entries(const json& failure, const char* group,
                                 fmt::format_string<const std::string&, std::string> format) {
  std::vector<std::string> list;
  if (!failure.contains(group) || !failure[group].is_object()) return list;
  for (const auto& [name, value] : failure[group].items()) list.push_back(fmt::format(format, name, text_of(value)));
  return list;
}

}  // namespace

std::string what_happened(const json& failure) {
  std::string text = failure.value("sentence", "it did not say why");
  const std::vector<std::string> where = entries(failure, "where", "{} {}");
  if (where.empty()) return text;
  if (text.ends_with('.')) text.pop_back();
  return text + fmt::format(" ({})", fmt::join(where, ", "));
}

std::string failure_text(const json& failure) {
  std::string text = what_happened(failure);
  const std::vector<std::string> advice = entries(failure, "advice", "{}: {}");
  if (advice.empty()) return text;
  return fmt::format("{}{} Try {}.", text, text.ends_with('.') ? "" : ".", fmt::join(advice, " or "));
}

}  // namespace cupola
