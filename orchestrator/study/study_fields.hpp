#pragma once
#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "orchestrator/study/data_table.hpp"
#include "orchestrator/study/study_metrics.hpp"
#include "schemas/campaign.hpp"
#include "schemas/task.hpp"

namespace cupola {

/// What a study compares of one finished stage, read from its task folder.  Cells in undecomposed order, SI.
struct StudyFields {
  std::string mesh_hash;
  std::vector<double> points;             ///< n x 3
  std::vector<std::int64_t> cell_points;  ///< cells x 8
  std::vector<double> cell_volume;
  std::vector<double> solids_volume;                   ///< of each cell; 0 where the bed stands still
  std::vector<double> velocity;                        ///< of the solids, x 3
  std::vector<double> temperature;                     ///< of the solids; empty without
  std::vector<double> zone_x, zone_area, zone_height;  ///< columns; NaN where there is no zone; empty without
  std::optional<double> pressure_drop, top_gas_temperature;
};

/// @throws Failure where the result cannot be read
StudyFields read_study_fields(const std::filesystem::path& task_folder, TaskKind kind, const Campaign& campaign);

/// The single number that stands for a metric in a table: mean temperature (K), mean height (m), rms speed (m/s),
/// pressure drop (Pa), top gas (K); none where the fields do not have it.
std::optional<double> metric_figure(StudyMetric metric, const StudyFields& fields);

/// Error of `fields` against those of a reference, in the metric's norm; none where one of them lacks it.  On one mesh
/// cell by cell; on two meshes as means over blocks of the coarser cell's size across and up (the depth is averaged).
std::optional<double> metric_error(StudyMetric metric, const StudyFields& fields, const StudyFields& reference);

/// Error against published data, one value a point: temperature and descent at (x, z), the zone's height at x.
std::optional<double> metric_error(StudyMetric metric, const StudyFields& fields, const DataTable& data);

/// Error against a number: mean height of the zone, pressure drop, top gas.
std::optional<double> metric_error(StudyMetric metric, const StudyFields& fields, double number);

/// Columns that the data of a metric need.
std::vector<std::string> data_columns(StudyMetric metric);

}  // namespace cupola
