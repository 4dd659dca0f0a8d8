#include "stage_tracer/granular_field.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "physics/equations/face_geometry.hpp"
#include "physics/projection/bed_state.hpp"
#include "schemas/failure.hpp"

namespace cupola {
namespace {

bool is_outlet(const BedMesh& mesh, std::int64_t face) {
  const BedMesh::Patch* patch = mesh.patch_of(face);
  return patch != nullptr && patch->kind == BedMesh::PatchKind::outlet;
}

}  // namespace

std::vector<bool> persistent_species(const Campaign& campaign) {
  std::vector<bool> result;
  for (const Species& species : campaign.species) result.push_back(!species.softening.has_value());
  return result;
}

ChargedFlux charged_flux(const Campaign& campaign, const Charge& charge) {
  ChargedFlux result;
  for (std::size_t s = 0; s < campaign.species.size(); ++s) {
    result.volume_rate += charge.volume_rate[s];
    if (campaign.species[s].softening) continue;
    result.persistent_share += charge.volume_share[s];
    result.persistent_mass_rate += charge.mass_rate[s];
  }
  return result;
}

double packing_near_stock(const BedMesh& mesh, const Campaign& campaign, const std::vector<bool>& bed,
                          const std::vector<double>& solids_fraction) {
  const double stock = std::min(campaign.charging.stock_line, campaign.top());
  const std::vector<double> thickness = charge_of(campaign).layer_thickness;
  const double thickest = thickness.empty() ? 0 : *std::max_element(thickness.begin(), thickness.end());
  double upper = stock - thickest;
  double lower = stock - 3 * thickest;
  const double middle = 0.5 * (stock + campaign.bottom());
  if (lower < middle) {
    upper = stock - std::min(thickest, 0.25 * (stock - middle));
    lower = middle;
  }
  double volume = 0;
  double solids = 0;
  // Layers may be thinner than cells: the band is widened downwards until it holds some.
  for (; volume == 0 && lower > 2 * campaign.bottom() - stock; lower -= 0.02 * (stock - campaign.bottom())) {
    for (std::size_t c = 0; c < mesh.cells(); ++c) {
      const double z = mesh.cell_centre[c][2];
      if (!bed[c] || z < lower || z > upper) continue;
      volume += mesh.cell_volume[c];
      solids += mesh.cell_volume[c] * solids_fraction[c];
    }
  }
  if (!(solids > 0)) {
    throw Failure(ExitCode::wrong_input,
                  fmt::format("the DEM result holds no solids between z = {:.3g} and {:.3g} m below the stock line",
                              lower, upper));
  }
  return solids / volume;
}

std::vector<double> persistent_share(const BedMesh& mesh, const Campaign& campaign, double charged_share,
                                     const std::vector<double>& ore_temperature) {
  std::vector<double> share(mesh.cells(), charged_share);
  const Softening* softening = nullptr;
  double none_below = -std::numeric_limits<double>::infinity();
  for (const Species& species : campaign.species) {
    if (!species.softening) continue;
    softening = &*species.softening;
    none_below = std::max(none_below, species.none_below);
  }
  if (softening == nullptr) return share;
  for (std::size_t c = 0; c < mesh.cells(); ++c) {
    const bool molten = !ore_temperature.empty() && ore_temperature[c] >= softening->melted;
    if (molten || mesh.cell_centre[c][2] < none_below) share[c] = 1;
  }
  return share;
}

std::vector<double> raceway_sink(const BedMesh& mesh, const Campaign& campaign, const std::vector<bool>& bed,
                                 const std::vector<double>& weights, double total) {
  std::vector<double> sink(mesh.cells(), 0.0);
  double weight_sum = 0;
  for (const double weight : weights) weight_sum += weight;
  for (std::size_t r = 0; r < campaign.raceways.size(); ++r) {
    std::vector<std::int64_t> cells = raceway_cells(mesh, campaign.raceways[r]);
    std::erase_if(cells, [&](std::int64_t cell) { return !bed[cell]; });
    double volume = 0;
    for (const std::int64_t cell : cells) volume += mesh.cell_volume[cell];
    if (cells.empty()) {
      throw Failure(ExitCode::wrong_input,
                    fmt::format("raceways[{}].box holds no cell of the bed; make it at least a cell large", r));
    }
    for (const std::int64_t cell : cells) sink[cell] += total * weights[r] / weight_sum / volume;
  }
  return sink;
}

std::vector<double> raceway_weights(const Campaign& campaign, const std::vector<double>& removal_by_raceway) {
  std::vector<double> weights = removal_by_raceway;
  if (weights.size() != campaign.raceways.size() || !(*std::max_element(weights.begin(), weights.end()) > 0)) {
    weights.clear();
    for (const Raceway& raceway : campaign.raceways) weights.push_back(raceway.dem_removal_rate);
  }
  return weights;
}

std::vector<double> interpolate_flux(const BedMesh& mesh, const std::vector<bool>& bed,
                                     const std::vector<Vector3>& flux) {
  std::vector<double> result(mesh.faces(), 0.0);
  for (std::size_t f = 0; f < mesh.faces(); ++f) {
    const std::int64_t owner = mesh.face_owner[f];
    const std::int64_t neighbour = mesh.face_neighbour[f];
    Vector3 value{};
    if (neighbour >= 0) {
      if (!bed[owner] && !bed[neighbour]) continue;
      const double owner_weight = bed[owner] ? (bed[neighbour] ? 0.5 : 1.0) : 0.0;
      for (std::size_t k = 0; k < 3; ++k)
        value[k] = owner_weight * flux[owner][k] + (1 - owner_weight) * flux[neighbour][k];
    } else {
      if (!bed[owner] || !is_outlet(mesh, static_cast<std::int64_t>(f))) continue;
      value = flux[owner];
    }
    result[f] = dot(value, mesh.face_area[f]);
  }
  return result;
}

std::vector<StockFace> stock_faces(const BedMesh& mesh, const std::vector<bool>& bed,
                                   const std::vector<double>& face_flux, double volume_rate) {
  std::vector<StockFace> faces;
  double inflow = 0;
  for (std::size_t f = 0; f < mesh.faces(); ++f) {
    const std::int64_t owner = mesh.face_owner[f];
    const std::int64_t neighbour = mesh.face_neighbour[f];
    StockFace face{static_cast<std::int64_t>(f), -1, 0};
    if (neighbour >= 0 && bed[owner] != bed[neighbour]) {
      face.cell = bed[owner] ? owner : neighbour;
      face.volume_rate = bed[owner] ? -face_flux[f] : face_flux[f];
    } else if (neighbour < 0 && bed[owner] && is_outlet(mesh, face.face)) {
      face.cell = owner;
      face.volume_rate = -face_flux[f];
    }
    if (face.cell < 0 || face.volume_rate <= 0) continue;
    inflow += face.volume_rate;
    faces.push_back(face);
  }
  if (faces.empty()) {
    throw Failure(ExitCode::wrong_input,
                  "nothing flows in through the stock plane of the granular field; lengthen the DEM stage "
                  "(dem.stop.at_most) until the bed descends");
  }
  for (StockFace& face : faces) face.volume_rate *= volume_rate / inflow;
  return faces;
}

std::vector<bool> stagnant_cells(const BedMesh& mesh, const Campaign& campaign, const GranularField& field) {
  const PathField paths(mesh, field.face_flux, field.storage);
  const double height = std::min(campaign.charging.stock_line, campaign.top()) - campaign.bottom();
  const double longest_stay = 10 * height / campaign.descent_rate;
  std::vector<bool> stagnant(mesh.cells());
  for (std::size_t c = 0; c < mesh.cells(); ++c) {
    stagnant[c] = field.bed[c] && paths.crossing_time(static_cast<std::int64_t>(c)) > longest_stay;
  }
  return stagnant;
}

}  // namespace cupola
