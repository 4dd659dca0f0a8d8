#pragma once
#include <limits>
#include <optional>

#include "stage_tracer/dem_result.hpp"
#include "stage_tracer/granular_field.hpp"
#include "stage_tracer/predictor/surrogate_flux.hpp"

namespace cupola {

/// Cell data of a prediction: the share f that its flux and storage follow.
inline constexpr const char* predicted_share_name = "persistent_share";

/// The granular field that follows the cohesive zone: the surrogate's alone, or that of the last DEM stage corrected by
/// what the surrogate says the zone's shift changes, q = q_DEM + q_surrogate(f) - q_surrogate(f of the DEM stage).
class PredictedField {
 public:
  /// @param dem             null: without a DEM result
  /// @param dem_temperature K, what that DEM stage softened and melted by
  /// @throws Failure wrong_input: no raceways, descent or persistent species
  PredictedField(FoamCase& foam, const BedMesh& mesh, const Campaign& campaign, const DemResult* dem,
                 const std::vector<double>& dem_temperature);

  /// The persistent species' share of the solids flux, f, all cells, that an ore temperature, K, stands for: that of
  /// the tracer stage (`persistent_share`), but in the cell in which the ore melts it is the mean over the cell's
  /// height.
  [[nodiscard]] std::vector<double> share(const std::vector<double>& ore_temperature) const;
  /// Lets flux and storage follow a share f, all cells.
  void follow(const std::vector<double>& share);
  /// Finds the cells in which the bed stands still.
  void mark_stagnant() { field_.stagnant = stagnant_cells(mesh_, campaign_, field_); }
  /// Solids fraction, all cells, as the storage uses it: not 0.
  [[nodiscard]] const std::vector<double>& packing() const { return packing_; }
  /// Of the persistent species in the raceways, 1/s, all cells.
  [[nodiscard]] const std::vector<double>& sink() const { return sink_; }

  [[nodiscard]] const GranularField& field() const { return field_; }
  /// Of the persistent species in the volume charged.
  [[nodiscard]] double charged_share() const { return charged_.persistent_share; }

 private:
  const BedMesh& mesh_;
  const Campaign& campaign_;
  ChargedFlux charged_;
  double lowest_ore_ = -std::numeric_limits<double>::infinity();  ///< m, `none_below`
  GranularField field_;
  std::vector<double> packing_;
  std::vector<double> sink_;  ///< 1/s
  std::optional<SurrogateFlux> surrogate_;
  std::vector<double> measured_;        ///< face flux of the DEM result; empty without
  std::vector<double> surrogate_then_;  ///< the surrogate's for the DEM stage's zone
};

}  // namespace cupola
