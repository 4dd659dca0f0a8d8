#pragma once
#include <nlohmann/json.hpp>
#include <vector>

#include "orchestrator/report/stage_report.hpp"
#include "schemas/campaign.hpp"

/// What the report's charts draw, as JSON columns; SI, null where a value is missing.
namespace cupola {

/// The furnace seen from the front: profile, stock line, tuyeres, raceways, species, the guessed cohesive zone.
nlohmann::json furnace_drawing(const Campaign& campaign);

/// One entry an episode: `episode`, `time` and the series of the stage's history.
nlohmann::json dem_history(const std::vector<StageReport>& stages);
nlohmann::json tracer_history(const std::vector<StageReport>& stages);

/// One entry an episode that has a cohesive zone: `episode`, `x`, `height_melted`, `height_softened`; columns of one x
/// (along the depth) are averaged by area.
nlohmann::json cohesive_zones(const std::vector<StageReport>& stages);

/// Fields in the mid-plane: `y`, the cells' corners `x`, `z` and centres `x_centre`, `z_centre`, and by episode
/// `fields`.
nlohmann::json field_maps(const std::vector<StageReport>& stages, const Campaign& campaign);

}  // namespace cupola
