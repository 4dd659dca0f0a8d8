#include "orchestrator/report/json_numbers.hpp"

#include <fmt/format.h>

#include <cmath>
#include <cstdlib>

namespace cupola {

nlohmann::json rounded(double value, int digits) {
  if (!std::isfinite(value)) {
    return nullptr;
  }
  return std::strtod(fmt::format("{:.{}g}", value, digits).c_str(), nullptr);
}

nlohmann::json rounded(const std::vector<double>& values, int digits) {
  nlohmann::json list = nlohmann::json::array();
  for (const double value : values) {
    list.push_back(rounded(value, digits));
  }
  return list;
}

std::optional<double> number_at(const nlohmann::json& value, const std::string& pointer) {
  const nlohmann::json::json_pointer place(pointer);
  if (!value.is_structured() || !value.contains(place) || !value.at(place).is_number()) {
    return std::nullopt;
  }
  const double number = value.at(place).get<double>();
  return std::isfinite(number) ? std::optional(number) : std::nullopt;
}

nlohmann::json number_or_null(const nlohmann::json& value, const std::string& pointer) {
  const std::optional<double> number = number_at(value, pointer);
  return number ? nlohmann::json(*number) : nlohmann::json(nullptr);
}

std::string percent(double share) {
  return share >= 1 ? fmt::format("{:.0f} %", 100 * share) : fmt::format("{:.2g} %", 100 * share);
}

}  // namespace cupola
