#include "orchestrator/study/study_metrics.hpp"

#include <algorithm>
#include <array>
#include <utility>

#include "orchestrator/episode_fields.hpp"
#include "orchestrator/study/study_file.hpp"

namespace cupola {
namespace {

struct Words {
  const char* name;
  const char* unit;
  const char* norm;
};

/// In the order of StudyMetric.
constexpr std::array<Words, 5> words = {{
    {"temperature", "1",
     "solids temperature: rms difference over the bed's solids, over rms(T - 293 K) of the reference"},
    {"cohesive_zone", "m", "height of the melting isotherm: rms difference over the columns"},
    {"descent", "1", "solids velocity: rms difference over the bed's solids, over the rms speed of the reference"},
    {"pressure_drop", "1", "pressure at the inlets above that at the outlet: difference over that of the reference"},
    {"top_gas_temperature", "K", "temperature of the gas that leaves: difference"},
}};

const Words& words_of(StudyMetric metric) { return words.at(static_cast<std::size_t>(metric)); }

}  // namespace

std::string metric_name(StudyMetric metric) { return words_of(metric).name; }
std::string metric_unit(StudyMetric metric) { return words_of(metric).unit; }
std::string metric_norm(StudyMetric metric) { return words_of(metric).norm; }

std::optional<StudyMetric> metric_of(const std::string& name) {
  const auto found = std::find_if(words.begin(), words.end(), [&](const Words& one) { return name == one.name; });
  if (found == words.end()) return std::nullopt;
  return static_cast<StudyMetric>(found - words.begin());
}

std::string metric_missing(StudyMetric metric, const Campaign& scene, StudyStage stage) {
  const bool only_dem = stage == StudyStage::dem;
  const bool gas = scene.scene.gas && (only_dem ? scene.dem.gas != DemSettings::GasModel::none
                                                : scene.tracer.gas != TracerSettings::GasModel::none);
  if (metric == StudyMetric::descent) return "";
  if (metric == StudyMetric::pressure_drop) return gas ? "" : "the scene has no gas";
  if (only_dem) return "a DEM stage computes no temperatures";
  if (!scene.heat) return "the scene is cold: it has no `heat`";
  if (metric == StudyMetric::top_gas_temperature) return gas ? "" : "the scene has no gas";
  if (metric == StudyMetric::cohesive_zone && !has_cohesive_zone(scene)) return "no species of the scene softens";
  return "";
}

}  // namespace cupola
