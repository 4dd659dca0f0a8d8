#pragma once
#include <fmt/format.h>

#include <string>
#include <utility>
#include <vector>

#include "schemas/yaml_document.hpp"

/// Checks for meaning, one file a topic.  Every comparison is written so that NaN (missing, reported already) passes.
namespace cupola::meaning {

inline constexpr double rounding = 1e-9;      ///< m
inline constexpr double bulk_packing = 0.55;  ///< of a freshly charged layer

struct Context {
  Context(const Campaign& campaign_to_check, YamlDocument& its_document);

  const Campaign& campaign;
  YamlDocument& document;
  std::vector<std::string> names;  ///< of the species
  bool named = true;               ///< every one a sound name
  bool shaped = false;             ///< the profile is there and sound

  template <typename... Arguments>
  void add(const std::string& path, fmt::format_string<Arguments...> text, Arguments&&... arguments) {
    document.errors.push_back(document.error_at(path, fmt::format(text, std::forward<Arguments>(arguments)...)));
  }
  template <typename... Arguments>
  void add_at_key(const std::string& path, fmt::format_string<Arguments...> text, Arguments&&... arguments) {
    document.errors.push_back(document.error_at_key(path, fmt::format(text, std::forward<Arguments>(arguments)...)));
  }
  [[nodiscard]] bool has(const std::string& path) const { return document.values.contains(path); }
  [[nodiscard]] bool known(const std::string& name) const;
};

void check_contacts(Context& context);
void check_gas(Context& context);
void check_charging(Context& context);
void check_launch(Context& context);

}  // namespace cupola::meaning
