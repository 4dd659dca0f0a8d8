#include "physics/projection/clean_field.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "physics/equations/cell_failure.hpp"
#include "physics/equations/face_geometry.hpp"
#include "physics/mesh/cell_locator.hpp"
#include "physics/projection/bed_projection.hpp"
#include "schemas/failure.hpp"

namespace cupola {
namespace {

/// Speed that even a cell at rest lends to the weight of a face's correction, over the mean speed: keeps the equation
/// regular.
constexpr double least_relative_speed = 1e-3;
/// The projected field's divergence is right to this share of the total sink.
constexpr double projection_tolerance = 1e-12;
constexpr double acceptable_projection = 1e-10;

double magnitude(const Vector3& v) { return std::sqrt(dot(v, v)); }

class Cleaning {
 public:
  Cleaning(const BedMesh& bed_mesh, const RawGranularField& raw_field)
      : mesh(bed_mesh), raw(raw_field), geometry(bed_mesh), faces(mesh, geometry, raw.bed) {
    sink.resize(mesh.cells());
    double total = 0;
    for (std::size_t cell = 0; cell < mesh.cells(); ++cell) {
      if (!raw.bed[cell]) continue;
      sink[cell] = raw.sink[cell] * mesh.cell_volume[cell];
      total += sink[cell];
      flux_scale += std::abs(sink[cell]);
    }
    total_sink = total;
    flux = raw.coke_flux;
    for (std::size_t cell = 0; cell < mesh.cells(); ++cell) {
      if (!raw.bed[cell]) flux[cell] = {0, 0, 0};
      for (const double part : flux[cell]) {
        if (!std::isfinite(part)) {
          throw cell_failure(mesh, "granular flux is not a number", cell);
        }
      }
    }
  }

  /// Conservative exchange between neighbouring bed cells: each pass moves a twelfth of the smaller volume's share
  /// through a face, so that the sum of volume x flux stays and a uniform field stays as it is.
  void smooth() {
    std::vector<Vector3> before;
    for (int pass = 0; pass < raw.smoothing_passes; ++pass) {
      before = flux;
      for (std::size_t face = 0; face < mesh.faces(); ++face) {
        const auto owner = mesh.face_owner[face];
        const auto neighbour = mesh.face_neighbour[face];
        if (!faces.inside(face)) continue;
        const double volume = std::min(mesh.cell_volume[owner], mesh.cell_volume[neighbour]) / 12;
        for (std::size_t axis = 0; axis < 3; ++axis) {
          const double moved = volume * (before[neighbour][axis] - before[owner][axis]);
          flux[owner][axis] += moved / mesh.cell_volume[owner];
          // A periodic face's neighbour has a face of its own.
          if (face < mesh.internal_faces()) flux[neighbour][axis] -= moved / mesh.cell_volume[neighbour];
        }
      }
    }
  }

  void mirror() {
    const CellLocator locator(mesh);
    const auto before = flux;
    for (std::size_t cell = 0; cell < mesh.cells(); ++cell) {
      const Vector3& centre = mesh.cell_centre[cell];
      const auto image = locator.find({-centre[0], centre[1], centre[2]});
      const double size = std::cbrt(mesh.cell_volume[cell]);
      if (image < 0 || std::abs(mesh.cell_centre[image][0] + centre[0]) > 0.01 * size ||
          raw.bed[image] != raw.bed[cell]) {
        throw Failure(ExitCode::wrong_input,
                      "the mesh is not its own mirror image in x: clean the granular field without mirror symmetry");
      }
      flux[cell] = {(before[cell][0] - before[image][0]) / 2, (before[cell][1] + before[image][1]) / 2,
                    (before[cell][2] + before[image][2]) / 2};
    }
  }

  /// Fluxes through faces: linear interpolation inside, nothing through walls, the total sink through the stock plane.
  void interpolate(const std::vector<Vector3>& field) {
    face_flux.assign(mesh.faces(), 0);
    std::vector<double> inflow(mesh.faces(), 0.0);
    for (std::size_t face = 0; face < mesh.faces(); ++face) {
      const auto owner = mesh.face_owner[face];
      if (faces.inside(face)) {
        const double before = geometry.owner_distance[face], beyond = geometry.neighbour_distance[face];
        const Vector3& here = field[owner];
        const Vector3& there = field[mesh.face_neighbour[face]];
        face_flux[face] =
            (beyond * dot(here, mesh.face_area[face]) + before * dot(there, mesh.face_area[face])) / (before + beyond);
      } else if (faces.in_stock_plane(face)) {
        const auto cell = faces.cell_below(face);
        inflow[face] = std::max(0.0, (cell == owner ? -1 : 1) * dot(field[cell], mesh.face_area[face]));
      }
    }
    faces.set_inflow(total_sink, inflow, face_flux);
  }

  /// The smallest correction, weighted with 1/speed, that makes div = -sink.
  void project(FoamCase& foam) {
    double mean_speed = 0, volume = 0;
    for (std::size_t cell = 0; cell < mesh.cells(); ++cell) {
      if (!raw.bed[cell]) continue;
      mean_speed += magnitude(flux[cell]) * mesh.cell_volume[cell];
      volume += mesh.cell_volume[cell];
    }
    mean_speed /= volume;
    std::vector<double> mobility(mesh.cells(), 1);
    for (std::size_t cell = 0; cell < mesh.cells() && mean_speed > 0; ++cell)
      mobility[cell] = magnitude(flux[cell]) / mean_speed + least_relative_speed;
    // Where nothing is removed, the field's own fluxes are the scale.
    double scale = flux_scale;
    for (const double value : face_flux) scale = std::max(scale, std::abs(value));
    BedProjection(foam, mesh, geometry, raw.bed)
        .project(mobility, sink, projection_tolerance * scale, acceptable_projection * scale, face_flux);
  }

  /// rms of (div q + sink) over rms of |q|/cell size.
  [[nodiscard]] double error() const {
    const auto outflow = FaceGeometry::outflow(mesh, face_flux);
    double wrong = 0, usual = 0;
    for (std::size_t cell = 0; cell < mesh.cells(); ++cell) {
      if (!raw.bed[cell]) continue;
      const double volume = mesh.cell_volume[cell];
      wrong += (outflow[cell] + sink[cell]) * (outflow[cell] + sink[cell]) / volume;
      const double rate = magnitude(raw.coke_flux[cell]) / std::cbrt(volume);
      usual += rate * rate * volume;
    }
    return usual > 0 ? std::sqrt(wrong / usual) : 0;
  }

  /// |cleaned - raw|/|raw| over bed cells.
  [[nodiscard]] double change() const {
    const auto cleaned = geometry.cell_vectors(mesh, face_flux);
    double changed = 0, all = 0;
    for (std::size_t cell = 0; cell < mesh.cells(); ++cell) {
      if (!raw.bed[cell]) continue;
      for (std::size_t axis = 0; axis < 3; ++axis) {
        const double difference = cleaned[cell][axis] - raw.coke_flux[cell][axis];
        changed += difference * difference * mesh.cell_volume[cell];
        all += raw.coke_flux[cell][axis] * raw.coke_flux[cell][axis] * mesh.cell_volume[cell];
      }
    }
    return all > 0 ? std::sqrt(changed / all) : 0;
  }

  std::vector<Vector3> flux;      ///< in cells, m/s
  std::vector<double> face_flux;  ///< m3/s out of the owner

 private:
  const BedMesh& mesh;
  const RawGranularField& raw;
  FaceGeometry geometry;
  BedFaces faces;
  std::vector<double> sink;  ///< m3/s a cell
  double total_sink = 0;     ///< m3/s
  double flux_scale = 0;     ///< m3/s, sum of the sinks' magnitudes
};

}  // namespace

CleanGranularField clean_granular_field(FoamCase& foam, const BedMesh& mesh, const RawGranularField& raw) {
  if (std::find(raw.bed.begin(), raw.bed.end(), true) == raw.bed.end()) {
    throw Failure(ExitCode::wrong_input, "no cell of the mesh lies below the stock line")
        .at("key", "charging.stock_line");
  }
  CleanGranularField result;
  Cleaning cleaning(mesh, raw);
  cleaning.interpolate(cleaning.flux);
  result.error_before = cleaning.error();
  cleaning.smooth();
  if (raw.mirror_symmetric) cleaning.mirror();
  cleaning.interpolate(cleaning.flux);
  cleaning.project(foam);
  result.error_after = cleaning.error();
  result.change = cleaning.change();
  result.face_flux = std::move(cleaning.face_flux);
  return result;
}

}  // namespace cupola
