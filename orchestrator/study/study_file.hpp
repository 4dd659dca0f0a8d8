#pragma once
#include <array>
#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "orchestrator/study/study_metrics.hpp"
#include "schemas/campaign.hpp"
#include "schemas/campaign_reader.hpp"

namespace cupola {

/// What is run for each setting.
enum class StudyStage { dem, tracer, episode, campaign };
/// Its words in a study file, in the same order.
inline constexpr std::array<const char*, 4> study_stage_words = {"dem", "tracer", "episode", "campaign"};

/// A study as it stands, or with its section `reduced` in place of what that names: quick enough to see whether its
/// results still hold.
enum class StudySize { full, reduced };

/// Campaign keys that change together, and their values.
struct StudyAxis {
  std::vector<std::string> keys;
  std::vector<std::vector<nlohmann::ordered_json>> values;  ///< by key, then by place; as written
  std::vector<std::vector<nlohmann::ordered_json>> in_si;   ///< the same in SI, to compare and to draw
  [[nodiscard]] std::size_t size() const { return values.front().size(); }
};

/// One combination of the axes' values.
struct StudySetting {
  std::vector<std::size_t> place;  ///< by axis
  nlohmann::ordered_json values;   ///< by key, as written
  nlohmann::ordered_json in_si;
  Campaign campaign;
  std::string campaign_text;             ///< as a campaign file
  std::optional<std::size_t> reference;  ///< index of the setting it is compared with
  [[nodiscard]] std::string label() const;
};

/// What the error is measured against.
struct StudyReference {
  enum class Kind { setting, run, analytic, data };
  Kind kind = Kind::setting;
  std::filesystem::path run;                          ///< absolute
  std::map<StudyMetric, std::filesystem::path> data;  ///< absolute
  std::string sentence;                               ///< for people
};

/// A study file that has been read and looked over: everything that can be known to be wrong before anything runs.
struct Study {
  std::string name, about;
  std::filesystem::path file, scene_file;
  Campaign scene;                     ///< with `change`
  nlohmann::ordered_json scene_root;  ///< the same as a campaign file
  StudySize size = StudySize::full;
  StudyStage stage = StudyStage::tracer;
  bool begins_with_packing = false;
  std::vector<StudyAxis> axes;
  std::vector<StudySetting> settings;
  int seeds = 1;
  StudyReference reference;
  std::vector<StudyMetric> metrics;
  int jobs = 1;
};

/// A study, or all errors of its file at once.
struct ReadStudy {
  Study study;  ///< valid only without errors
  std::vector<CampaignError> errors;
  [[nodiscard]] bool ok() const { return errors.empty(); }
};

/// @throws Failure input_output where the file cannot be read
ReadStudy read_study(const std::filesystem::path& file, StudySize size = StudySize::full);

/// Like read_study, all errors joined into one Failure (wrong_input).
Study load_study(const std::filesystem::path& file, StudySize size = StudySize::full);

/// `tracer.time_step = 5 s, random_seed = 2`: keys and their values for people.
std::string settings_text(const nlohmann::ordered_json& values);

/// What a DEM stage of the first episode sees of a campaign, as a text: campaigns with the same text share it.
std::string seen_by_dem_stage(const Campaign& campaign);

/// The JSON Schema of the study file, as published in schemas/study.schema.json.
const std::string& study_schema();

}  // namespace cupola
