#include "orchestrator/study/study_reader.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <tuple>

#include "physics/plan/plan.hpp"
#include "schemas/campaign_from_document.hpp"
#include "schemas/failure.hpp"
#include "schemas/files.hpp"
#include "schemas/resolved_campaign.hpp"
#include "schemas/schema_check.hpp"
#include "schemas/yaml_text.hpp"

namespace cupola {
namespace {

using Json = nlohmann::ordered_json;
namespace fs = std::filesystem;

std::optional<StudyScene> read_scene(const fs::path& file, StudyErrors& errors, std::vector<CampaignError>& of_scene) {
  if (!fs::is_regular_file(file)) {
    errors.at("scene", fmt::format("there is no campaign file {}", file.string()));
    return std::nullopt;
  }
  const std::string text = read_text(file);
  of_scene = read_campaign_text(text, file.string()).errors;
  if (!of_scene.empty()) return std::nullopt;
  StudyScene scene{parse_yaml(text, file.string()), {}};
  scene.changed = scene.document.root;
  return scene;
}

void read_change(const Json& root, StudyScene& scene, Study& study, StudyErrors& errors) {
  const Json changes = root.value("change", Json::object());
  Json changed = scene.changed;
  for (const auto& [path, value] : changes.items())
    if (const auto key = known_key(path, scene.changed, path_of("change", path), errors)) key->set(changed, value);
  const ReadCampaign read = scene.read(changed);
  for (const CampaignError& error : read.errors) {
    std::string place = "change";
    for (const auto& [path, value] : changes.items())
      if (error.key == path || error.key.starts_with(path + ".") || error.key.starts_with(path + "["))
        place = path_of("change", path);
    errors.of_campaign(place, {error});
  }
  if (read.ok()) scene.changed = changed;
  study.scene = scene.read(scene.changed).campaign;
  study.scene_root = scene.changed;
}

/// The document with its section `reduced` in place of what that names; `change` goes key by key.
void reduce(YamlDocument& document) {
  const Json reduced = document.root.value("reduced", Json::object());
  if (reduced.empty()) {
    document.errors.push_back(document.error_at("", "has no section `reduced`, which --reduced asks for"));
    return;
  }
  for (const auto& [word, value] : reduced.items()) {
    if (word == "change" && document.root.contains(word))
      document.root[word].update(value);
    else
      document.root[word] = value;
    // What is wrong with it is said where it stands.
    const std::string from = path_of("reduced", word);
    for (auto* places : {&document.keys, &document.values}) {
      const std::map<std::string, Place> before = *places;
      for (const auto& [path, place] : before)
        if (path.starts_with(from)) (*places)[path.substr(std::string("reduced.").size())] = place;
    }
  }
}

/// What a plan refuses is refused before anything runs, too.
void check_plans(Study& study, StudyErrors& errors) {
  for (const StudySetting& setting : study.settings)
    for (const std::string& refusal : make_plan(setting.campaign).refusals)
      errors.at("vary", fmt::format("{}: {}", setting.label(), refusal));
}

Study read_document(YamlDocument& document, const fs::path& file, StudySize size,
                    std::vector<CampaignError>& of_scene) {
  StudyErrors errors(document);
  const Json& root = document.root;
  Study study;
  study.file = fs::absolute(file);
  study.size = size;
  study.name = root["study"].get<std::string>();
  study.about = root.value("about", "");
  study.scene_file = (study.file.parent_path() / root["scene"].get<std::string>()).lexically_normal();
  study.stage = static_cast<StudyStage>(
      std::find(study_stage_words.begin(), study_stage_words.end(), root["stage"].get<std::string>()) -
      study_stage_words.begin());
  study.begins_with_packing = root.value("begin", "empty") == "packing";
  study.seeds = root.value("seeds", 1);
  study.jobs = root.value("jobs", 1);
  auto scene = read_scene(study.scene_file, errors, of_scene);
  if (!scene) return study;
  read_change(root, *scene, study, errors);
  read_axes(root["vary"], *scene, study, errors);
  if (study.begins_with_packing && study.stage == StudyStage::campaign)
    errors.at("begin", "a campaign always begins with an empty furnace: leave `begin` out");
  read_reference(root, study, errors);
  if (errors.count() == 0) check_plans(study, errors);
  return study;
}

void put_in_order(std::vector<CampaignError>& errors) {
  const auto key = [](const CampaignError& e) { return std::tie(e.file, e.line, e.column, e.key, e.message); };
  std::sort(errors.begin(), errors.end(), [&](const auto& a, const auto& b) { return key(a) < key(b); });
  errors.erase(
      std::unique(errors.begin(), errors.end(), [&](const auto& a, const auto& b) { return key(a) == key(b); }),
      errors.end());
}

}  // namespace

ReadCampaign StudyScene::read(const Json& root) const {
  YamlDocument with = document;
  with.root = root;
  return read_campaign_document(std::move(with));
}

void StudyErrors::of_campaign(const std::string& path, const std::vector<CampaignError>& errors) {
  for (const CampaignError& error : errors) {
    const bool own = path.ends_with(error.key) || path.find("." + error.key + "[") != std::string::npos;
    at(path, own || error.key.empty() ? error.message : fmt::format("{}: {}", error.key, error.message));
  }
}

std::optional<CampaignKey> known_key(const std::string& path, const Json& scene, const std::string& place,
                                     StudyErrors& errors) {
  try {
    return CampaignKey(path, scene);
  } catch (const std::invalid_argument& problem) {
    errors.at_key(place, problem.what());
    return std::nullopt;
  }
}

ReadStudy read_study(const fs::path& file, StudySize size) {
  if (!fs::is_regular_file(file))
    throw Failure(ExitCode::input_output, fmt::format("{}: there is no such study file", file.string()))
        .at("file", file.string());
  ReadStudy read;
  YamlDocument document = parse_yaml(read_text(file), file.string());
  if (document.complete && document.root.is_object()) {
    static const SchemaValidator validator(nlohmann::json::parse(study_schema()));
    check_against_schema(document, validator);
  } else if (document.errors.empty()) {
    document.errors.push_back(document.error_at("", "expected a section of keys, beginning with `study: name`"));
  }
  if (size == StudySize::reduced && document.errors.empty()) reduce(document);
  std::vector<CampaignError> of_scene;
  if (document.errors.empty()) read.study = read_document(document, file, size, of_scene);
  read.errors = std::move(document.errors);
  read.errors.insert(read.errors.end(), of_scene.begin(), of_scene.end());
  put_in_order(read.errors);
  return read;
}

Study load_study(const fs::path& file, StudySize size) {
  ReadStudy read = read_study(file, size);
  if (!read.ok()) throw Failure(ExitCode::wrong_input, to_text(read.errors)).at("file", file.string());
  return std::move(read.study);
}

std::string StudySetting::label() const { return settings_text(values); }

std::string settings_text(const Json& values) {
  std::string text;
  for (const auto& [key, value] : values.items())
    text += fmt::format("{}{} = {}", text.empty() ? "" : ", ", key,
                        value.is_string() ? value.get<std::string>() : value.dump());
  return text;
}

std::string seen_by_dem_stage(const Campaign& campaign) {
  Json seen = resolved_json(campaign);
  for (const char* key : {"campaign", "tracer", "strategy", "converged", "launch"}) seen.erase(key);
  seen["heat"] = campaign.heat.has_value();
  return seen.dump();
}

}  // namespace cupola
