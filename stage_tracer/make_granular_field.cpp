#include "stage_tracer/make_granular_field.hpp"

#include <spdlog/spdlog.h>

#include <algorithm>
#include <cmath>

#include "physics/projection/bed_state.hpp"
#include "physics/projection/clean_field.hpp"
#include "schemas/failure.hpp"
#include "stage_tracer/columns.hpp"

namespace cupola {
namespace {

/// Heights between which the shaft is free of raceways and of freshly charged layers: the middle third, m.
struct MidShaft {
  double lower, upper;
};

MidShaft mid_shaft(const Campaign& campaign) {
  double lower = campaign.bottom();
  for (const Raceway& raceway : campaign.raceways) lower = std::max(lower, raceway.box[1][2]);
  const double upper = std::min(campaign.charging.stock_line, campaign.top());
  const double third = (upper - lower) / 3;
  return {lower + third, upper - third};
}

/// Persistent volume that passes the middle third of the shaft, m3/s: mean over its cells.
double flux_at_mid_shaft(const BedMesh& mesh, const Campaign& campaign, const std::vector<bool>& bed,
                         const std::vector<Vector3>& flux) {
  const MidShaft middle = mid_shaft(campaign);
  double total = 0;
  for (const Column& column : mesh_columns(mesh, bed)) {
    double sum = 0;
    int count = 0;
    for (const std::int64_t cell : column.cells) {
      const double z = mesh.cell_centre[cell][2];
      if (z < middle.lower || z > middle.upper) continue;
      const double area = 0.5 * (std::abs(mesh.face_area[mesh.cell_faces[cell][4]][2]) +
                                 std::abs(mesh.face_area[mesh.cell_faces[cell][5]][2]));
      sum -= flux[cell][2] * area;
      ++count;
    }
    if (count > 0) total += sum / count;
  }
  return total;
}

/// Persistent volume that the bed below mid-shaft gained a second in the DEM window, m3/s (MODEL 8).
double storage_below_mid_shaft(const BedMesh& mesh, const Campaign& campaign, const std::vector<bool>& bed,
                               const std::vector<double>& share, const std::vector<double>& growth) {
  const MidShaft middle = mid_shaft(campaign);
  double total = 0;
  for (std::size_t c = 0; c < mesh.cells(); ++c) {
    if (bed[c] && mesh.cell_centre[c][2] < 0.5 * (middle.lower + middle.upper))
      total += share[c] * growth[c] * mesh.cell_volume[c];
  }
  return total;
}

bool same_box(const Raceway& a, const Raceway& b) {
  const auto near = [](double x, double y) { return std::abs(x - y) < 1e-9; };
  return near(a.box[0][0], -b.box[1][0]) && near(a.box[1][0], -b.box[0][0]) && near(a.box[0][2], b.box[0][2]) &&
         near(a.box[1][2], b.box[1][2]) && near(a.dem_removal_rate, b.dem_removal_rate);
}

/// Whether raceways and inlets are mirror-symmetric in x (the geometry always is).
bool mirror_symmetric(const Campaign& campaign) {
  const auto mirrored = [&](const Raceway& raceway) {
    return std::any_of(campaign.raceways.begin(), campaign.raceways.end(),
                       [&](const Raceway& other) { return same_box(raceway, other); });
  };
  if (!std::all_of(campaign.raceways.begin(), campaign.raceways.end(), mirrored)) return false;
  double left = 0;
  double right = 0;
  if (campaign.scene.gas) {
    for (const Inlet& inlet : campaign.scene.gas->inlets) {
      // Whatever the inlets state, the two sides must state the same.
      const double stated = inlet.mass_flow + inlet.velocity + inlet.pressure;
      if (inlet.side == Inlet::Side::left) left += stated;
      if (inlet.side == Inlet::Side::right) right += stated;
    }
  }
  return std::abs(left - right) < 1e-6 * (left + right + 1);
}

void clean(FoamCase& foam, const BedMesh& mesh, const Campaign& campaign, const std::vector<Vector3>& flux,
           const std::vector<double>& sink, GranularField& field) {
  RawGranularField raw;
  raw.coke_flux = flux;
  raw.sink = sink;
  raw.bed = field.bed;
  raw.smoothing_passes = campaign.tracer.smoothing_passes;
  raw.mirror_symmetric = mirror_symmetric(campaign);
  CleanGranularField cleaned = clean_granular_field(foam, mesh, raw);
  field.face_flux = std::move(cleaned.face_flux);
  field.error_before = cleaned.error_before;
  field.error_after = cleaned.error_after;
  field.change = cleaned.change;
}

}  // namespace

GranularField make_granular_field(FoamCase& foam, const BedMesh& mesh, const Campaign& campaign, const DemResult& dem,
                                  const std::vector<double>& ore_temperature) {
  GranularField field;
  field.bed = bed_cells(mesh, campaign);
  field.solids_fraction = dem.solids_fraction;
  field.contact_fraction = dem.contact_fraction;
  field.storage.assign(mesh.cells(), 1.0);
  field.removal_rate.assign(mesh.cells(), 0.0);
  field.face_flux.assign(mesh.faces(), 0.0);
  field.stagnant = field.bed;
  field.charge = charge_of(campaign, packing_near_stock(mesh, campaign, field.bed, dem.solids_fraction));
  if (!(campaign.descent_rate > 0)) return field;

  const ChargedFlux charged = charged_flux(campaign, field.charge);
  const bool known_sink = !campaign.raceways.empty() && charged.persistent_share > 0 && dem.persistent_removal_rate > 0;
  // Where nothing persists, the whole flux moves the bed.
  const double charged_share = charged.persistent_share > 0 ? charged.persistent_share : 1;
  const std::vector<double> share = persistent_share(mesh, campaign, charged_share, ore_temperature);

  std::vector<Vector3> flux(mesh.cells());
  for (std::size_t c = 0; c < mesh.cells(); ++c) {
    field.storage[c] = share[c] * std::max(dem.solids_fraction[c], least_solids_fraction);
    for (std::size_t k = 0; k < 3; ++k) flux[c][k] = share[c] * dem.solids_fraction[c] * dem.solids_velocity[c][k];
  }
  const double passing = flux_at_mid_shaft(mesh, campaign, field.bed, flux);
  const double coke_rate = charged_share * charged.volume_rate;
  if (known_sink) {
    field.scale = charged.persistent_mass_rate / dem.persistent_removal_rate;
    field.scale_check = passing * field.scale / coke_rate - 1;
    field.storage_over_removal =
        storage_below_mid_shaft(mesh, campaign, field.bed, share, dem.solids_growth) * field.scale / coke_rate;
  } else {
    if (!(passing > 0)) {
      throw Failure(
          ExitCode::wrong_input,
          "the bed of the DEM result does not descend, but descent_rate is positive; lengthen dem.stop.at_most");
    }
    field.scale = coke_rate / passing;
  }
  for (Vector3& value : flux) {
    for (double& component : value) component *= field.scale;
  }

  std::vector<double> sink(mesh.cells(), 0.0);
  if (known_sink) {
    sink = raceway_sink(mesh, campaign, field.bed, raceway_weights(campaign, dem.removal_by_raceway), coke_rate);
    for (std::size_t c = 0; c < mesh.cells(); ++c) field.removal_rate[c] = sink[c] / field.storage[c];
  }
  if (campaign.tracer.clean_field && known_sink) {
    clean(foam, mesh, campaign, flux, sink, field);
  } else {
    field.face_flux = interpolate_flux(mesh, field.bed, flux);
  }
  field.stock_faces = stock_faces(mesh, field.bed, field.face_flux, charged.volume_rate);
  field.stagnant = stagnant_cells(mesh, campaign, field);

  if (std::abs(field.scale_check) > 0.1) {
    spdlog::warn(
        "the flux through the middle of the shaft differs from the raceways' removal by {:.0f} %: the DEM stage is not "
        "steady yet",
        100 * field.scale_check);
  }
  return field;
}

}  // namespace cupola
