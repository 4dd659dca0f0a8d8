#include "orchestrator/study/campaign_key.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <charconv>
#include <regex>
#include <stdexcept>

#include "schemas/campaign_reader.hpp"
#include "schemas/nearest.hpp"
#include "schemas/units.hpp"

namespace cupola {
namespace {

using Json = nlohmann::ordered_json;
using Schema = nlohmann::json;

[[noreturn]] void refuse(const std::string& sentence) { throw std::invalid_argument(sentence); }

const Schema& schema_of_campaign() {
  static const Schema schema = Schema::parse(campaign_schema());
  return schema;
}

/// `scene.gas.inlets[0].mass_flow` as scene, gas, inlets, [0], mass_flow.
std::vector<std::string> steps_of(const std::string& path) {
  static const std::regex step(R"(([A-Za-z0-9_-]+)((\[(\d{1,6}|\*)\])*)(\.|$))");
  static const std::regex index(R"(\[(\d+|\*)\])");
  std::vector<std::string> steps;
  std::size_t at = 0;
  for (auto match = std::sregex_iterator(path.begin(), path.end(), step); match != std::sregex_iterator(); ++match) {
    if (static_cast<std::size_t>(match->position()) != at || match->length() == 0) break;
    at += static_cast<std::size_t>(match->length());
    steps.push_back((*match)[1]);
    const std::string indices = (*match)[2];
    for (auto one = std::sregex_iterator(indices.begin(), indices.end(), index); one != std::sregex_iterator(); ++one)
      steps.push_back(one->str());
  }
  if (at != path.size() || steps.empty() || path.ends_with('.') || path.size() > 500)
    refuse("expected the path of a campaign key, such as tracer.time_step or scene.gas.inlets[0].mass_flow");
  return steps;
}

std::vector<std::string> names_in(const Json* section) {
  std::vector<std::string> names;
  if (section != nullptr && section->is_object())
    for (const auto& [name, member] : section->items()) names.push_back(name);
  return names;
}

/// Every path of the schema that ends with this name.
void find_homes(const Schema& schema, const std::string& name, const std::string& path,
                std::vector<std::string>& homes) {
  if (schema.contains("items") && schema["items"].is_object()) find_homes(schema["items"], name, path + "[*]", homes);
  if (!schema.contains("properties")) return;
  for (const auto& [key, member] : schema["properties"].items()) {
    const std::string inner = path.empty() ? key : path + "." + key;
    if (key == name) homes.push_back(inner);
    find_homes(member, name, inner, homes);
  }
}

std::string unknown_key(const Schema& schema, const std::string& name, const std::string& where) {
  std::vector<std::string> known;
  for (const auto& [key, member] : schema["properties"].items()) known.push_back(key);
  std::string hint = suggestion(name, known);
  if (hint.empty()) {
    std::vector<std::string> homes;
    find_homes(schema_of_campaign(), name, "", homes);
    hint = homes.empty() ? fmt::format(" (known there: {})", fmt::join(known, ", "))
                         : fmt::format(" (did you mean `{}`?)", fmt::join(homes, "` or `"));
  }
  return fmt::format("a campaign has no key `{}`{}{}", name, where.empty() ? "" : " in `" + where + "`", hint);
}

/// Goes down one step at a time, in the schema and in the scene together.
class Walk {
 public:
  explicit Walk(const Json& scene) : schema_(&schema_of_campaign()), scene_(&scene) {}

  void step(const std::string& name) {
    if (name.starts_with('['))
      into_list(name);
    else
      into_section(name);
    where_ += name.starts_with('[') || where_.empty() ? name : "." + name;
  }
  [[nodiscard]] const Schema& schema() const { return *schema_; }

 private:
  void into_list(const std::string& index) {
    if (!schema_->contains("items") || !(*schema_)["items"].is_object())
      refuse(fmt::format("`{}` is no list whose members have keys", where_));
    const std::size_t size = scene_ != nullptr && scene_->is_array() ? scene_->size() : 0;
    std::size_t place = 0;
    if (index != "[*]") std::from_chars(index.data() + 1, index.data() + index.size() - 1, place);
    if (place >= size)
      refuse(fmt::format("the scene has {} of `{}`, counted from 0: there is no {}", size, where_, index));
    schema_ = &(*schema_)["items"];
    scene_ = &scene_->at(place);
  }

  void into_section(const std::string& name) {
    const Json* section = scene_ != nullptr && scene_->is_object() ? scene_ : nullptr;
    scene_ = section != nullptr && section->contains(name) ? &section->at(name) : nullptr;
    if (schema_->contains("properties")) {
      if (!(*schema_)["properties"].contains(name)) refuse(unknown_key(*schema_, name, where_));
      schema_ = &(*schema_)["properties"][name];
      return;
    }
    const bool named = schema_->contains("patternProperties") ||
                       (schema_->contains("additionalProperties") && (*schema_)["additionalProperties"].is_object());
    if (!named) refuse(fmt::format("`{}` is a value and has no keys of its own", where_));
    if (scene_ == nullptr)
      refuse(fmt::format("the scene has no `{}` in `{}`{}", name, where_, suggestion(name, names_in(section))));
    schema_ = schema_->contains("patternProperties") ? &schema_->at("patternProperties").front()
                                                     : &(*schema_)["additionalProperties"];
  }

  const Schema* schema_;
  const Json* scene_;
  std::string where_;
};

void put(Json& section, const std::vector<std::string>& steps, std::size_t at, const Json& value) {
  if (at == steps.size()) {
    section = value;
    return;
  }
  const std::string& step = steps[at];
  if (step == "[*]") {
    for (Json& member : section) put(member, steps, at + 1, value);
  } else if (step.starts_with('[')) {
    std::size_t place = 0;
    std::from_chars(step.data() + 1, step.data() + step.size() - 1, place);
    put(section.at(place), steps, at + 1, value);
  } else {
    if (!section.is_object()) section = Json::object();
    put(section[step], steps, at + 1, value);
  }
}

}  // namespace

CampaignKey::CampaignKey(const std::string& path, const Json& scene) : path_(path), steps_(steps_of(path)) {
  Walk walk(scene);
  for (const std::string& step : steps_) walk.step(step);
  unit_ = walk.schema().value("x-unit", "");
}

void CampaignKey::set(Json& campaign, const Json& value) const { put(campaign, steps_, 0, value); }

Json CampaignKey::in_si(const Json& value) const {
  if (unit_.empty() || !value.is_string()) return value;
  try {
    return to_si(value.get<std::string>(), unit_);
  } catch (const UnitError&) {
    return value;
  }
}

}  // namespace cupola
