#pragma once
#include <functional>
#include <stdexcept>

#include "orchestrator/study/campaign_key.hpp"
#include "orchestrator/study/study_file.hpp"
#include "schemas/yaml_document.hpp"

namespace cupola {

/// The scene of a study as it is written, to be changed key by key.
struct StudyScene {
  YamlDocument document;           ///< of the campaign file, quantities as written
  nlohmann::ordered_json changed;  ///< root with the study's `change`
  /// The scene with other keys, and what is wrong with it. @param root of a campaign file
  [[nodiscard]] ReadCampaign read(const nlohmann::ordered_json& root) const;
};

/// Errors of a study file, gathered while it is read.
class StudyErrors {
 public:
  explicit StudyErrors(YamlDocument& document) : document_(document) {}
  void at(const std::string& path, const std::string& message) {
    document_.errors.push_back(document_.error_at(path, message));
  }
  void at_key(const std::string& path, const std::string& message) {
    document_.errors.push_back(document_.error_at_key(path, message));
  }
  /// What a changed scene is refused for, said at the place in the study that changed it.
  void of_campaign(const std::string& path, const std::vector<CampaignError>& errors);
  [[nodiscard]] std::size_t count() const { return document_.errors.size(); }

 private:
  YamlDocument& document_;
};

/// The key, or none where there is no such one (said at its place).
std::optional<CampaignKey> known_key(const std::string& path, const nlohmann::ordered_json& scene,
                                     const std::string& place, StudyErrors& errors);

/// The values of an axis' key: a list as it is, or a range.
std::vector<nlohmann::ordered_json> values_of(const nlohmann::ordered_json& written, const CampaignKey& key,
                                              const std::string& place, StudyErrors& errors);

/// Axes with every value looked over by itself, and their combinations.
void read_axes(const nlohmann::ordered_json& vary, const StudyScene& scene, Study& study, StudyErrors& errors);

/// `reference` and `metrics`, once the settings are known.
void read_reference(const nlohmann::ordered_json& root, Study& study, StudyErrors& errors);

}  // namespace cupola
