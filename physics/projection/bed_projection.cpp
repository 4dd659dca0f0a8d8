#include "physics/projection/bed_projection.hpp"

#include <cmath>

#include "schemas/failure.hpp"

namespace cupola {

bool BedFaces::in_stock_plane(std::size_t face) const {
  const auto neighbour = mesh_.face_neighbour[face];
  const bool owner_in_bed = bed_[mesh_.face_owner[face]];
  if (std::abs(geometry_.normal[face][2]) < 0.5) return false;
  if (neighbour >= 0) return owner_in_bed != bed_[neighbour];
  const auto* outlet = mesh_.find_patch("outlet");
  const auto number = static_cast<std::int64_t>(face);
  return owner_in_bed && outlet != nullptr && number >= outlet->first_face &&
         number < outlet->first_face + outlet->faces;
}

void BedFaces::set_inflow(double total, const std::vector<double>& share, std::vector<double>& face_flux) const {
  std::vector<std::size_t> plane;
  double sum = 0;
  double area = 0;
  for (std::size_t face = 0; face < mesh_.faces(); ++face) {
    if (!in_stock_plane(face)) continue;
    plane.push_back(face);
    sum += share[face];
    area += geometry_.area[face];
  }
  if (plane.empty())
    throw Failure(ExitCode::wrong_input, "no face of the mesh lies in the stock plane")
        .at("key", "charging.stock_line");
  for (const auto face : plane) {
    const double part = sum > 0 ? share[face] / sum : geometry_.area[face] / area;
    face_flux[face] = (bed_[mesh_.face_owner[face]] ? -1 : 1) * part * total;
  }
}

void BedProjection::project(const std::vector<double>& mobility, const std::vector<double>& sink, double tolerance,
                            double acceptable, std::vector<double>& face_flux) {
  CellCoefficients coefficients{std::vector<double>(mesh_.cells(), 0), std::vector<double>(mesh_.faces(), 0),
                                std::vector<double>(mesh_.internal_faces(), 0), true};
  for (std::size_t face = 0; face < mesh_.faces(); ++face) {
    if (!faces_.inside(face)) continue;
    const auto owner = mesh_.face_owner[face];
    const auto neighbour = mesh_.face_neighbour[face];
    const double conductance = geometry_.area[face] / (geometry_.owner_distance[face] / mobility[owner] +
                                                       geometry_.neighbour_distance[face] / mobility[neighbour]);
    coefficients.owner_row[face] = conductance;
    coefficients.diagonal[owner] += conductance;
    if (face < mesh_.internal_faces()) {
      coefficients.neighbour_row[face] = conductance;
      coefficients.diagonal[neighbour] += conductance;
    }
  }
  auto source = FaceGeometry::outflow(mesh_, face_flux);
  bool reference_set = false;
  for (std::size_t cell = 0; cell < mesh_.cells(); ++cell) {
    source[cell] = bed_[cell] ? -(source[cell] + sink[cell]) : 0;
    if (!bed_[cell]) coefficients.diagonal[cell] = 1;
    // The potential is known up to a constant only: it is 0 in the first cell of the bed.
    if (bed_[cell] && !reference_set) {
      coefficients.diagonal[cell] *= 2;
      reference_set = true;
    }
  }
  equation_.solve("projection of the granular field", coefficients, source, potential_, tolerance, acceptable);
  for (std::size_t face = 0; face < mesh_.faces(); ++face) {
    if (!faces_.inside(face)) continue;
    face_flux[face] +=
        coefficients.owner_row[face] * (potential_[mesh_.face_owner[face]] - potential_[mesh_.face_neighbour[face]]);
  }
}

}  // namespace cupola
