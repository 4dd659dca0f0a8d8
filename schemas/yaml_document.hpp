#pragma once
#include <map>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "schemas/campaign_reader.hpp"

namespace cupola {

/// Place in a text, both from 1.
struct Place {
  int line = 1;
  int column = 1;
};

/// One YAML document as JSON values in the order of the text, with the place of every key and value.  Paths are written
/// as in CampaignError: `scene.gas.inlets[0].mass_flow`; the whole document is "".
struct YamlDocument {
  std::string file;
  nlohmann::ordered_json root;
  std::map<std::string, Place> keys;    ///< where the key of a path stands
  std::map<std::string, Place> values;  ///< where the value of a path begins
  std::vector<CampaignError> errors;    ///< all that is wrong so far
  bool complete = false;                ///< read to its end; else the last error says where it broke off

  /// An error at the value of a path, or at the nearest value around it.
  [[nodiscard]] CampaignError error_at(const std::string& path, const std::string& message) const;
  /// An error at the key of a path.
  [[nodiscard]] CampaignError error_at_key(const std::string& path, const std::string& message) const;
  /// The document under a key of the root, its paths beginning there.
  [[nodiscard]] YamlDocument below(const std::string& key) const;
};

std::string path_of(const std::string& parent, const std::string& key);
std::string path_of(const std::string& parent, std::size_t index);

/// Never throws for what stands in the text: syntax errors and repeated keys are in `errors`.  Aliases, several
/// documents, more than 64 levels and more than 100,000 values are refused.
YamlDocument parse_yaml(const std::string& text, const std::string& file_name);

}  // namespace cupola
