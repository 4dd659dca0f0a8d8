#include "stage_tracer/predictor/predicted_field.hpp"

#include <algorithm>
#include <numeric>

#include "physics/projection/bed_state.hpp"
#include "schemas/failure.hpp"
#include "stage_tracer/make_granular_field.hpp"

namespace cupola {
namespace {

/// A bed that no DEM stage has built: the expected packing, and in the raceways at most what their void leaves.
GranularField expected_field(const BedMesh& mesh, const Campaign& campaign) {
  GranularField field;
  field.bed = bed_cells(mesh, campaign);
  field.solids_fraction.assign(mesh.cells(), 0.0);
  for (std::size_t c = 0; c < mesh.cells(); ++c) field.solids_fraction[c] = field.bed[c] ? expected_packing : 0;
  for (const Raceway& raceway : campaign.raceways) {
    for (const std::int64_t cell : raceway_cells(mesh, raceway))
      field.solids_fraction[cell] = std::min(field.solids_fraction[cell], 1 - raceway.void_fraction);
  }
  field.contact_fraction = field.solids_fraction;
  field.charge = charge_of(campaign, expected_packing);
  return field;
}

}  // namespace

PredictedField::PredictedField(FoamCase& foam, const BedMesh& mesh, const Campaign& campaign, const DemResult* dem,
                               const std::vector<double>& dem_temperature)
    : mesh_(mesh), campaign_(campaign) {
  if (campaign.raceways.empty() || !(campaign.descent_rate > 0)) {
    throw Failure(ExitCode::wrong_input,
                  "a prediction needs a bed that descends into raceways: give the campaign raceways and a positive "
                  "descent_rate, or march instead");
  }
  if (dem != nullptr) {
    field_ = make_granular_field(foam, mesh, campaign, *dem, dem_temperature);
    measured_ = field_.face_flux;
  } else {
    field_ = expected_field(mesh, campaign);
  }
  for (const double fraction : field_.solids_fraction) packing_.push_back(std::max(fraction, least_solids_fraction));
  for (const Species& species : campaign.species) {
    if (species.softening) lowest_ore_ = std::max(lowest_ore_, species.none_below);
  }
  charged_ = charged_flux(campaign, field_.charge);
  if (!(charged_share() > 0)) {
    throw Failure(ExitCode::wrong_input,
                  "a prediction needs a species that does not melt: it carries the bed's motion into the raceways; add "
                  "coke to charging.layers, or march instead")
        .at("key", "charging.layers");
  }
  std::vector<double> weights =
      raceway_weights(campaign, dem != nullptr ? dem->removal_by_raceway : std::vector<double>{});
  if (!(std::accumulate(weights.begin(), weights.end(), 0.0) > 0)) weights.assign(weights.size(), 1.0);
  sink_ = raceway_sink(mesh, campaign, field_.bed, weights, charged_share() * charged_.volume_rate);
  std::vector<double> removed(mesh.cells());
  for (std::size_t c = 0; c < mesh.cells(); ++c) removed[c] = sink_[c] * mesh.cell_volume[c];
  surrogate_.emplace(foam, mesh, field_.bed, removed);
  if (dem != nullptr) surrogate_then_ = (*surrogate_)(share(dem_temperature));
}

std::vector<double> PredictedField::share(const std::vector<double>& ore_temperature) const {
  std::vector<double> f = persistent_share(mesh_, campaign_, charged_share(), ore_temperature);
  const Softening* softening = nullptr;
  for (const Species& species : campaign_.species) {
    if (species.softening) softening = &*species.softening;
  }
  if (softening == nullptr || ore_temperature.empty()) return f;
  for (std::size_t c = 0; c < mesh_.cells(); ++c) {
    const auto number = static_cast<std::int64_t>(c);
    const auto at_face = [&](std::size_t side) {
      const std::int64_t other = mesh_.across(number, mesh_.cell_faces[c][side]);
      return other >= 0 && field_.bed[other] ? 0.5 * (ore_temperature[c] + ore_temperature[other]) : ore_temperature[c];
    };
    const double lower = at_face(4);
    const double upper = at_face(5);
    const bool crossed = upper < softening->melted && lower > softening->melted;
    if (!field_.bed[c] || !crossed || mesh_.cell_centre[c][2] < lowest_ore_) continue;
    f[c] = charged_share() + (1 - charged_share()) * (lower - softening->melted) / (lower - upper);
  }
  return f;
}

void PredictedField::follow(const std::vector<double>& share) {
  field_.face_flux = (*surrogate_)(share);
  for (std::size_t face = 0; face < measured_.size(); ++face)
    field_.face_flux[face] += measured_[face] - surrogate_then_[face];
  field_.storage.resize(mesh_.cells());
  field_.removal_rate.resize(mesh_.cells());
  for (std::size_t c = 0; c < mesh_.cells(); ++c) {
    field_.storage[c] = share[c] * packing_[c];
    field_.removal_rate[c] = sink_[c] / field_.storage[c];
  }
  field_.stock_faces = stock_faces(mesh_, field_.bed, field_.face_flux, charged_.volume_rate);
}

}  // namespace cupola
