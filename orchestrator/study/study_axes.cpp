#include <fmt/format.h>

#include <cmath>
#include <set>
#include <string>

#include "orchestrator/report/json_numbers.hpp"
#include "orchestrator/study/study_reader.hpp"
#include "schemas/yaml_text.hpp"

namespace cupola {
namespace {

using Json = nlohmann::ordered_json;

constexpr std::size_t most_settings = 1000;
constexpr int most_points = 1000;

bool is_range(const Json& written) {
  return written.is_object() && written.contains("from") && written.contains("to") && written.contains("points");
}

std::vector<Json> range_of(const Json& range, const CampaignKey& key, const std::string& place, StudyErrors& errors) {
  const auto refuse = [&](const std::string& message) {
    errors.at(place, message);
    return std::vector<Json>{};
  };
  for (const auto& [word, value] : range.items())
    if (word != "from" && word != "to" && word != "points" && word != "spacing")
      return refuse(fmt::format("a range has from, to, points and spacing, but `{}` stands here", word));
  const Json from = key.in_si(range["from"]), to = key.in_si(range["to"]);
  if (!from.is_number() || !to.is_number())
    return refuse(fmt::format("`from` and `to` must be {}",
                              key.unit().empty() || key.unit() == "1" ? "numbers" : "quantities in " + key.unit()));
  if (!range["points"].is_number_integer() || range["points"] < 2 || range["points"] > most_points)
    return refuse(fmt::format("`points` must be a whole number from 2 to {}", most_points));
  const std::string spacing = range.value("spacing", "linear");
  if (spacing != "linear" && spacing != "logarithmic")
    return refuse(fmt::format("`spacing` must be linear or logarithmic, but is `{}`", spacing));
  const auto first = from.get<double>(), last = to.get<double>();
  if (spacing == "logarithmic" && (first <= 0 || last <= 0)) return refuse("a logarithmic range must be above 0");
  const bool whole = from.is_number_integer() && to.is_number_integer() && spacing == "linear";
  const int points = range["points"].get<int>();
  std::vector<Json> values;
  for (int i = 0; i < points; ++i) {
    const double share = static_cast<double>(i) / (points - 1);
    const double exact = spacing == "linear" ? first + share * (last - first) : first * std::pow(last / first, share);
    const auto value = rounded(exact).get<double>();  // six digits are what a person would write
    values.push_back(whole && value == std::floor(value) ? Json(static_cast<std::int64_t>(value)) : Json(value));
  }
  return values;
}

/// Where an axis stands in the file.
std::string place_of(std::size_t axis, const std::string& key) { return path_of(path_of("vary", axis), key); }

/// The key of the axis that an error of the scene is about, else its first one.
const std::string& key_about(const CampaignError& error, const StudyAxis& axis) {
  for (const std::string& key : axis.keys)
    if (error.key == key || error.key.starts_with(key + ".") || error.key.starts_with(key + "[")) return key;
  return axis.keys.front();
}

/// Every place of an axis by itself in the scene: what is wrong with it is said at its own values.
void check_places(const StudyAxis& axis, const std::vector<CampaignKey>& keys, std::size_t number,
                  const StudyScene& scene, const Study& study, StudyErrors& errors) {
  const std::string base = seen_by_dem_stage(study.scene);
  bool seen = false, all_read = true;
  for (std::size_t i = 0; i < axis.size(); ++i) {
    Json root = scene.changed;
    for (std::size_t k = 0; k < keys.size(); ++k) keys[k].set(root, axis.values[k][i]);
    const ReadCampaign read = scene.read(root);
    for (const CampaignError& error : read.errors)
      errors.of_campaign(path_of(place_of(number, key_about(error, axis)), i), {error});
    all_read = all_read && read.ok();
    if (!read.ok()) continue;
    for (std::size_t j = 0; j < i; ++j) {
      bool same = true;
      for (const std::vector<Json>& values : axis.in_si) same = same && values[j] == values[i];
      if (same) errors.at(path_of(place_of(number, axis.keys.front()), i), "stands in this list already");
    }
    seen = seen || seen_by_dem_stage(read.campaign) != base;
  }
  const std::string &first = axis.keys.front(), place = place_of(number, first);
  if (study.stage == StudyStage::tracer && seen)
    errors.at_key(place, fmt::format("the DEM stage sees `{}`, and with `stage: tracer` it is run once for all "
                                     "settings: write `stage: episode`",
                                     first));
  if (study.stage == StudyStage::dem && !seen && all_read && !first.starts_with("launch") && axis.size() > 1)
    errors.at_key(place, fmt::format("a DEM stage does not see `{}`: write `stage: tracer`", first));
}

void combine(const StudyScene& scene, Study& study, const std::vector<std::vector<CampaignKey>>& keys,
             StudyErrors& errors) {
  std::size_t count = 1;
  for (const StudyAxis& axis : study.axes) {
    count *= axis.size();
    if (count > most_settings) {
      errors.at("vary", fmt::format("more than {} settings: take fewer values", most_settings));
      return;
    }
  }
  for (std::size_t index = 0; index < count; ++index) {
    StudySetting setting;
    Json root = scene.changed;
    std::size_t rest = index;
    setting.place.resize(study.axes.size());
    for (std::size_t a = study.axes.size(); a-- > 0;) {
      setting.place[a] = rest % study.axes[a].size();
      rest /= study.axes[a].size();
    }
    for (std::size_t a = 0; a < study.axes.size(); ++a)
      for (std::size_t k = 0; k < keys[a].size(); ++k) {
        const std::size_t place = setting.place[a];
        keys[a][k].set(root, study.axes[a].values[k][place]);
        setting.values[keys[a][k].path()] = study.axes[a].values[k][place];
        setting.in_si[keys[a][k].path()] = study.axes[a].in_si[k][place];
      }
    ReadCampaign read = scene.read(root);
    if (!read.ok()) {
      for (const CampaignError& error : read.errors)
        errors.at("vary", fmt::format("{}: {}: {}", setting.label(), error.key, error.message));
      continue;
    }
    setting.campaign = std::move(read.campaign);
    setting.campaign_text = yaml_text(root);
    study.settings.push_back(std::move(setting));
  }
}

}  // namespace

std::vector<Json> values_of(const Json& written, const CampaignKey& key, const std::string& place,
                            StudyErrors& errors) {
  if (is_range(written)) return range_of(written, key, place, errors);
  if (written.is_array() && !written.empty()) return written.get<std::vector<Json>>();
  errors.at(place, "expected a list of values, or a range {from: …, to: …, points: …, spacing: linear or logarithmic}");
  return {};
}

void read_axes(const Json& vary, const StudyScene& scene, Study& study, StudyErrors& errors) {
  const std::size_t before = errors.count();
  std::vector<std::vector<CampaignKey>> keys;
  std::set<std::string> varied;
  for (std::size_t a = 0; a < vary.size(); ++a) {
    StudyAxis axis;
    std::vector<CampaignKey> its_keys;
    const std::size_t before_axis = errors.count();
    for (const auto& [path, written] : vary[a].items()) {
      const std::string place = place_of(a, path);
      const auto key = known_key(path, scene.changed, place, errors);
      if (!key) continue;
      if (!varied.insert(path).second) errors.at_key(place, fmt::format("`{}` is varied twice", path));
      std::vector<Json> values = values_of(written, *key, place, errors);
      if (values.empty()) continue;
      if (!axis.keys.empty() && values.size() != axis.size())
        errors.at(place, fmt::format("keys of one axis change together: `{}` has {} values, this one has {}",
                                     axis.keys.front(), axis.size(), values.size()));
      std::vector<Json> in_si;
      for (const Json& value : values) in_si.push_back(key->in_si(value));
      axis.keys.push_back(path);
      axis.values.push_back(std::move(values));
      axis.in_si.push_back(std::move(in_si));
      its_keys.push_back(*key);
    }
    if (axis.keys.empty()) continue;
    if (errors.count() == before_axis) check_places(axis, its_keys, a, scene, study, errors);
    keys.push_back(std::move(its_keys));
    study.axes.push_back(std::move(axis));
  }
  if (errors.count() == before) combine(scene, study, keys, errors);
}

}  // namespace cupola
