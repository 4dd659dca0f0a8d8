#include "orchestrator/stage_orders.hpp"

#include "orchestrator/prediction.hpp"
#include "schemas/field_file.hpp"

namespace cupola {
namespace {

using std::filesystem::path;

path result_of(const path& task) { return task / "result.hdf"; }

/// Temperatures that the DEM stage softens and melts by.
std::optional<path> temperatures(const std::vector<EpisodeFolders>& before, const path& run) {
  if (before.empty()) return usable_prediction(run);
  return result_of(before.back().correct.value_or(before.back().tracer));
}

/// The last correction that was measured.
std::optional<path> last_correction(const std::vector<EpisodeFolders>& before) {
  for (auto episode = before.rbegin(); episode != before.rend(); ++episode)
    if (episode->correct) return result_of(*episode->correct);
  return std::nullopt;
}

bool has_converged(const path& prediction) {
  return FieldFile(result_of(prediction), "tracer-result")
      .summary()
      .value(nlohmann::json::json_pointer("/prediction/converged"), false);
}

double layer_passage(const path& prediction) {
  return FieldFile(result_of(prediction), "tracer-result").summary().at("layer_passage").get<double>();
}

}  // namespace

std::optional<StageOrder> stage_order(TaskKind kind, const std::vector<EpisodeFolders>& before,
                                      const EpisodeFolders& now, const path& run, const Campaign& campaign) {
  StageOrder order;
  if (const auto file = temperatures(before, run); file && campaign.heat) order.inputs["solids_temperature"] = *file;
  if (kind == TaskKind::dem) {
    if (!before.empty()) order.inputs["packing"] = result_of(before.back().dem);
    return order;
  }
  order.inputs["granular"] = result_of(now.dem);
  const std::optional<path> prediction = now.predict && has_converged(*now.predict) ? now.predict : std::nullopt;
  switch (kind) {
    case TaskKind::predict:
      if (const auto correction = last_correction(before)) order.inputs["correction"] = *correction;
      return order;
    case TaskKind::tracer:
      if (!prediction) return order;
      order.inputs["prediction"] = result_of(*prediction);
      order.tracer_duration = campaign.predict_and_verify.windows * layer_passage(*prediction);
      return order;
    case TaskKind::correct:
      if (!prediction) return std::nullopt;
      order.inputs["prediction"] = result_of(*prediction);
      order.inputs["march"] = result_of(now.tracer);
      return order;
    default:
      return order;
  }
}

path softened_by(const std::vector<EpisodeFolders>& episodes, const path& run) {
  return temperatures({episodes.begin(), episodes.end() - 1}, run).value_or(path());
}

}  // namespace cupola
