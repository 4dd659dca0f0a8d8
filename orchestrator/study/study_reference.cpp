#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

#include "orchestrator/study/finished_stage.hpp"
#include "orchestrator/study/study_fields.hpp"
#include "orchestrator/study/study_reader.hpp"
#include "schemas/failure.hpp"
#include "schemas/files.hpp"

namespace cupola {
namespace {

using Json = nlohmann::ordered_json;
namespace fs = std::filesystem;

/// Index of the setting at these places.
std::size_t index_of(const Study& study, const std::vector<std::size_t>& place) {
  std::size_t index = 0;
  for (std::size_t a = 0; a < study.axes.size(); ++a) index = index * study.axes[a].size() + place[a];
  return index;
}

void read_setting(const Json& named, Study& study, StudyErrors& errors) {
  std::vector<std::optional<std::size_t>> fixed(study.axes.size());
  for (const auto& [key, value] : named.items()) {
    const std::string place = path_of("reference.setting", key);
    bool varied = false;
    for (std::size_t a = 0; a < study.axes.size(); ++a)
      for (std::size_t k = 0; k < study.axes[a].keys.size(); ++k) {
        if (study.axes[a].keys[k] != key) continue;
        varied = true;
        const Json wanted = CampaignKey(key, study.scene_root).in_si(value);
        const auto& values = study.axes[a].in_si[k];
        const auto found = std::find(values.begin(), values.end(), wanted);
        if (found == values.end()) {
          std::vector<std::string> there;
          for (const Json& one : study.axes[a].values[k]) there.push_back(one.dump());
          errors.at(place, fmt::format("not among the values of `{}`: {}", key, fmt::join(there, ", ")));
        } else {
          fixed[a] = static_cast<std::size_t>(found - values.begin());
        }
      }
    if (!varied) errors.at_key(place, fmt::format("`{}` is not varied in this study", key));
  }
  std::string rest;
  for (std::size_t a = 0; a < study.axes.size(); ++a)
    if (!fixed[a]) rest += fmt::format("{}{}", rest.empty() ? "" : ", ", fmt::join(study.axes[a].keys, ", "));
  study.reference.sentence =
      "the setting " + settings_text(named) + (rest.empty() ? "" : fmt::format(", each with its own {}", rest));
  if (study.settings.empty()) return;
  for (StudySetting& setting : study.settings) {
    std::vector<std::size_t> place = setting.place;
    for (std::size_t a = 0; a < place.size(); ++a) place[a] = fixed[a].value_or(place[a]);
    setting.reference = index_of(study, place);
  }
}

void read_run_reference(const std::string& path, Study& study, StudyErrors& errors) {
  study.reference.kind = StudyReference::Kind::run;
  study.reference.run = (study.file.parent_path() / path).lexically_normal();
  study.reference.sentence = "the run " + path;
  try {
    const TaskKind kind = study.stage == StudyStage::dem ? TaskKind::dem : TaskKind::tracer;
    const auto last = last_finished_stage(study.reference.run, kind);
    if (!last)
      errors.at("reference.run", fmt::format("{}: no {} stage of this run has finished: resume it first, or take "
                                             "another reference",
                                             study.reference.run.string(), kind == TaskKind::dem ? "DEM" : "tracer"));
    else if (!has_ended(study.reference.run))
      errors.at("reference.run", fmt::format("{}: this campaign has not come to its end: resume it first, or take "
                                             "another reference",
                                             study.reference.run.string()));
    else
      verify_manifest(*last);
  } catch (const Failure& failure) {
    errors.at("reference.run", failure.what());
  }
}

void read_data_reference(const Json& data, Study& study, StudyErrors& errors) {
  study.reference.kind = StudyReference::Kind::data;
  study.reference.sentence = "published data";
  for (const auto& [name, file] : data.items()) {
    const StudyMetric metric = metric_of(name).value();
    const fs::path path = (study.file.parent_path() / file.get<std::string>()).lexically_normal();
    try {
      read_data_table(path, data_columns(metric));
    } catch (const Failure& failure) {
      errors.at(path_of("reference.data", name), failure.what());
    }
    study.reference.data[metric] = path;
  }
}

}  // namespace

void read_reference(const Json& root, Study& study, StudyErrors& errors) {
  const Json& reference = root["reference"];
  if (reference.contains("setting")) read_setting(reference["setting"], study, errors);
  if (reference.contains("run")) read_run_reference(reference["run"].get<std::string>(), study, errors);
  if (reference.contains("data")) read_data_reference(reference["data"], study, errors);
  if (reference.contains("analytic")) {
    study.reference.kind = StudyReference::Kind::analytic;
    study.reference.sentence =
        "the one-dimensional counter-current bed of the scene (exact for a bed that moves evenly; what is not "
        "one-dimensional in the scene is in the error)";
  }
  for (std::size_t i = 0; i < root["metrics"].size(); ++i) {
    const std::string name = root["metrics"][i].get<std::string>();
    const StudyMetric metric = metric_of(name).value();
    const std::string place = path_of("metrics", i);
    study.metrics.push_back(metric);
    if (const std::string why = metric_missing(metric, study.scene, study.stage); !why.empty())
      errors.at(place, fmt::format("the scene has no `{}`: {}", name, why));
    else if (study.reference.kind == StudyReference::Kind::data && !study.reference.data.contains(metric))
      errors.at(place, fmt::format("`reference.data` names no file for `{}`", name));
    else if (study.reference.kind == StudyReference::Kind::analytic &&
             (metric == StudyMetric::temperature || metric == StudyMetric::descent))
      errors.at(place, fmt::format("the counter-current bed has no answer for `{}`: take another reference", name));
  }
}

}  // namespace cupola
