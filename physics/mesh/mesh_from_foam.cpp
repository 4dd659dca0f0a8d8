#include "physics/mesh/mesh_from_foam.hpp"

#include <Time.H>
#include <cyclicPolyPatch.H>
#include <fmt/format.h>
#include <polyMesh.H>

#include <algorithm>
#include <cmath>
#include <optional>

#include "physics/mesh/foam_errors.hpp"
#include "schemas/plain_path.hpp"

namespace cupola {
namespace {

Vector3 to_vector(const Foam::vector& v) { return {v.x(), v.y(), v.z()}; }

std::size_t index(std::int64_t i) { return static_cast<std::size_t>(i); }

BedMesh::PatchKind kind_of(const Foam::polyPatch& patch) {
  if (Foam::isA<Foam::cyclicPolyPatch>(patch)) return BedMesh::PatchKind::periodic;
  if (patch.type() == "wall") return BedMesh::PatchKind::wall;
  return patch.name() == "outlet" ? BedMesh::PatchKind::outlet : BedMesh::PatchKind::inlet;
}

void copy_faces(const Foam::polyMesh& foam, BedMesh& mesh) {
  const auto faces = static_cast<std::size_t>(foam.nFaces());
  mesh.internal_face_count = static_cast<std::size_t>(foam.nInternalFaces());
  mesh.face_points.resize(faces);
  mesh.face_neighbour.assign(faces, -1);
  mesh.face_partner.assign(faces, -1);
  for (std::size_t i = 0; i < faces; ++i) {
    const auto number = static_cast<Foam::label>(i);
    const Foam::face& face = foam.faces()[number];
    if (face.size() != 4) {
      throw Failure(ExitCode::wrong_input, fmt::format("face {} of the mesh has {} corners, not 4", i, face.size()));
    }
    for (std::size_t k = 0; k < 4; ++k) mesh.face_points[i][k] = face[static_cast<Foam::label>(k)];
    mesh.face_owner.push_back(foam.faceOwner()[number]);
    if (i < mesh.internal_face_count) mesh.face_neighbour[i] = foam.faceNeighbour()[number];
    mesh.face_area.push_back(to_vector(foam.faceAreas()[number]));
    mesh.face_centre.push_back(to_vector(foam.faceCentres()[number]));
  }
}

void copy_patches(const Foam::polyMesh& foam, BedMesh& mesh) {
  const Foam::polyBoundaryMesh& patches = foam.boundaryMesh();
  for (Foam::label i = 0; i < patches.size(); ++i) {
    const Foam::polyPatch& patch = patches[i];
    mesh.patches.push_back({patch.name(), kind_of(patch), patch.start(), patch.size()});
    const auto* periodic = Foam::isA<Foam::cyclicPolyPatch>(patch);
    if (periodic == nullptr) continue;
    const Foam::label partner_start = periodic->neighbPatch().start();
    for (Foam::label k = 0; k < patch.size(); ++k) {
      mesh.face_partner[index(patch.start() + k)] = partner_start + k;
      mesh.face_neighbour[index(patch.start() + k)] = foam.faceOwner()[partner_start + k];
    }
  }
}

/// The axis along which all corners of the face have one coordinate; x for the inclined ones.
std::size_t axis_of(const BedMesh& mesh, std::int64_t face) {
  for (const std::size_t axis : {2U, 1U}) {
    double lowest = mesh.points[index(mesh.face_points[index(face)][0])][axis];
    double highest = lowest;
    for (const std::int64_t corner : mesh.face_points[index(face)]) {
      lowest = std::min(lowest, mesh.points[index(corner)][axis]);
      highest = std::max(highest, mesh.points[index(corner)][axis]);
    }
    if (highest - lowest <= 1e-9 * (mesh.upper[axis] - mesh.lower[axis])) return axis;
  }
  return 0;
}

std::optional<std::int64_t> common_corner(const BedMesh& mesh, std::int64_t a, std::int64_t b, std::int64_t c) {
  const auto has = [&](std::int64_t face, std::int64_t corner) {
    const auto& corners = mesh.face_points[index(face)];
    return std::find(corners.begin(), corners.end(), corner) != corners.end();
  };
  for (const std::int64_t corner : mesh.face_points[index(a)]) {
    if (has(b, corner) && has(c, corner)) return corner;
  }
  return std::nullopt;
}

Failure no_hexahedron(std::size_t cell) {
  return Failure(ExitCode::wrong_input, fmt::format("cell {} of the mesh is no hexahedron between two levels, two "
                                                    "sections and two walls",
                                                    cell))
      .at("cell", std::to_string(cell));
}

void order_cell(const Foam::cell& faces, std::size_t cell, BedMesh& mesh) {
  if (faces.size() != 6) throw no_hexahedron(cell);
  std::array<std::int64_t, 6> ordered{-1, -1, -1, -1, -1, -1};
  for (Foam::label i = 0; i < 6; ++i) {
    const std::size_t axis = axis_of(mesh, faces[i]);
    const bool upper = mesh.face_centre[index(faces[i])][axis] > mesh.cell_centre[cell][axis];
    std::int64_t& place = ordered[2 * axis + (upper ? 1 : 0)];
    if (place >= 0) throw no_hexahedron(cell);
    place = faces[i];
  }
  mesh.cell_faces[cell] = ordered;
  // VTK's order: round the lower ring, then round the upper one.
  constexpr std::array<std::array<std::size_t, 2>, 4> ring{{{0, 0}, {1, 0}, {1, 1}, {0, 1}}};
  for (std::size_t upper = 0; upper < 2; ++upper) {
    for (std::size_t k = 0; k < 4; ++k) {
      const auto corner = common_corner(mesh, ordered[ring[k][0]], ordered[2 + ring[k][1]], ordered[4 + upper]);
      if (!corner) throw no_hexahedron(cell);
      mesh.cell_points[cell][4 * upper + k] = *corner;
    }
  }
}

}  // namespace

BedMesh mesh_from_foam(const std::filesystem::path& case_folder, const Campaign& campaign) {
  return with_foam_errors(
      ExitCode::input_output, fmt::format("OpenFOAM cannot read the mesh in {}", case_folder.string()), [&] {
        Foam::messageStream::level = 0;
        Foam::fileName::debug = 0;  // else it ends the program over a blank in the name of the folder it is started in
        const PlainPath plain(case_folder);
        const Foam::Time time(Foam::Time::controlDictName, plain.path().parent_path().string(),
                              Foam::fileName(plain.path().filename().string()), "system", "constant", false, false);
        const Foam::polyMesh foam(
            Foam::IOobject(Foam::polyMesh::defaultRegion, time.timeName(), time, Foam::IOobject::MUST_READ));
        BedMesh mesh;
        for (const Foam::point& point : foam.points()) mesh.points.push_back(to_vector(point));
        mesh.find_bounds();
        copy_faces(foam, mesh);
        copy_patches(foam, mesh);
        for (const double volume : foam.cellVolumes()) mesh.cell_volume.push_back(volume);
        for (const Foam::point& centre : foam.cellCentres()) mesh.cell_centre.push_back(to_vector(centre));
        mesh.cell_faces.resize(mesh.cells());
        mesh.cell_points.resize(mesh.cells());
        for (std::size_t cell = 0; cell < mesh.cells(); ++cell) {
          order_cell(foam.cells()[static_cast<Foam::label>(cell)], cell, mesh);
        }
        if (campaign.scene.geometry.sides == Geometry::Sides::periodic) {
          mesh.periodic_depth = campaign.scene.geometry.depth;
        }
        return mesh;
      });
}

}  // namespace cupola
