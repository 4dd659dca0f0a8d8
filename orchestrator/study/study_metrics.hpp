#pragma once
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

#include "schemas/campaign.hpp"

namespace cupola {

enum class StudyStage;

/// In what the error of a setting is measured.  T is compared as its rise over 293 K, as the convergence rules do.
enum class StudyMetric {
  temperature,          ///< of the solids: rms difference over the bed, over rms(T - 293 K) of the reference; 1
  cohesive_zone,        ///< rms difference of the melting isotherm's height over the columns, m
  descent,              ///< of the solids velocity: rms difference over the bed, over the rms speed of the reference; 1
  pressure_drop,        ///< from the inlets to the outlet: difference over that of the reference; 1
  top_gas_temperature,  ///< difference, K
};

/// `cohesive_zone`
std::string metric_name(StudyMetric metric);
std::optional<StudyMetric> metric_of(const std::string& name);
/// SI unit of the error; `1` where it is relative.
std::string metric_unit(StudyMetric metric);
/// The norm, in words.
std::string metric_norm(StudyMetric metric);

/// Why a study of this stage over this scene cannot have the metric; empty where it can.
std::string metric_missing(StudyMetric metric, const Campaign& scene, StudyStage stage);

}  // namespace cupola
