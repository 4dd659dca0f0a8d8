#include "orchestrator/campaign_difference.hpp"

#include <fmt/format.h>
#include <yaml-cpp/yaml.h>

#include <map>
#include <sstream>

#include "schemas/campaign_reader.hpp"
#include "schemas/failure.hpp"
#include "schemas/resolved_campaign.hpp"

namespace cupola {
namespace {

void flatten(const YAML::Node& node, const std::string& path, std::map<std::string, std::string>& leaves) {
  if (node.IsMap()) {
    for (const auto& entry : node) {
      const auto key = entry.first.as<std::string>();
      flatten(entry.second, path.empty() ? key : path + "." + key, leaves);
    }
  } else if (node.IsSequence()) {
    for (std::size_t i = 0; i < node.size(); ++i) flatten(node[i], fmt::format("{}[{}]", path, i), leaves);
  } else {
    leaves[path] = node.IsScalar() ? node.Scalar() : "nothing";
  }
}

std::map<std::string, std::string> leaves_of(const std::string& yaml) {
  std::map<std::string, std::string> leaves;
  flatten(YAML::Load(yaml), "", leaves);
  return leaves;
}

}  // namespace

std::vector<std::string> changed_keys(const std::string& there, const std::string& here) {
  const auto old_leaves = leaves_of(there), new_leaves = leaves_of(here);
  std::vector<std::string> changes;
  for (const auto& [key, value] : old_leaves) {
    const auto found = new_leaves.find(key);
    if (found == new_leaves.end())
      changes.push_back(fmt::format("{}: {} there, absent here", key, value));
    else if (found->second != value)
      changes.push_back(fmt::format("{}: {} there, {} here", key, value, found->second));
  }
  for (const auto& [key, value] : new_leaves)
    if (!old_leaves.contains(key)) changes.push_back(fmt::format("{}: absent there, {} here", key, value));
  return changes;
}

Campaign with_changed_key(const Campaign& campaign, const std::string& key, const std::string& value) {
  const YAML::Node root = YAML::Load(resolved_yaml(campaign));
  std::istringstream path(key);
  YAML::Node section = root;
  std::string name;
  std::getline(path, name, '.');
  for (std::string next; std::getline(path, next, '.'); name = next) {
    if (!section.IsMap() || !section[name])
      throw Failure(ExitCode::wrong_input, fmt::format("{}: the campaign has no such key.", key)).at("key", key);
    section.reset(section[name]);
  }
  section[name] = value;
  YAML::Emitter out;
  out.SetDoublePrecision(17);
  out << root;
  ReadCampaign changed = read_campaign_text(out.c_str(), "the campaign with a changed key");
  if (!changed.ok()) throw Failure(ExitCode::wrong_input, to_text(changed.errors)).at("key", key);
  return changed.campaign;
}

}  // namespace cupola
