#include "physics/mesh/bed_mesh.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <numeric>
#include <sstream>

#include "schemas/field_file.hpp"
#include "schemas/files.hpp"

namespace cupola {
namespace {

template <typename T, std::size_t columns>
std::vector<T> flattened(const std::vector<std::array<T, columns>>& rows) {
  std::vector<T> flat;
  flat.reserve(rows.size() * columns);
  for (const auto& row : rows) flat.insert(flat.end(), row.begin(), row.end());
  return flat;
}

template <std::size_t columns, typename T>
std::vector<std::array<T, columns>> in_rows(const std::vector<T>& flat) {
  std::vector<std::array<T, columns>> rows(flat.size() / columns);
  for (std::size_t i = 0; i < rows.size(); ++i) {
    std::copy_n(flat.begin() + static_cast<std::ptrdiff_t>(i * columns), columns, rows[i].begin());
  }
  return rows;
}

std::string patch_names(const std::vector<BedMesh::Patch>& patches) {
  std::string names;
  for (const auto& patch : patches) names += patch.name + "\n";
  return names;
}

std::vector<BedMesh::Patch> read_patches(const HdfReader& hdf, const std::filesystem::path& file) {
  const std::vector<std::int64_t> first = hdf.integers("Mesh/patch_first", -1, 1);
  const std::vector<std::int64_t> faces = hdf.integers("Mesh/patch_faces", static_cast<std::int64_t>(first.size()), 1);
  const std::vector<std::int64_t> kind = hdf.integers("Mesh/patch_kind", static_cast<std::int64_t>(first.size()), 1);
  std::istringstream names(hdf.text("Mesh/patch_names"));
  std::vector<BedMesh::Patch> patches(first.size());
  for (std::size_t i = 0; i < patches.size(); ++i) {
    if (!std::getline(names, patches[i].name) || kind[i] < 0 || kind[i] > 3) {
      throw Failure(ExitCode::wrong_input,
                    fmt::format("{}: the list of patches is damaged; prepare the task again", file.string()))
          .at("file", file.string());
    }
    patches[i].kind = static_cast<BedMesh::PatchKind>(kind[i]);
    patches[i].first_face = first[i];
    patches[i].faces = faces[i];
  }
  return patches;
}

/// Every index points at something that is there.
void check(const BedMesh& mesh, const std::filesystem::path& file) {
  const auto all_below = [](const auto& indices, std::int64_t least, std::size_t limit) {
    return std::all_of(indices.begin(), indices.end(),
                       [&](std::int64_t index) { return index >= least && index < static_cast<std::int64_t>(limit); });
  };
  bool sound = all_below(mesh.face_owner, 0, mesh.cells()) && all_below(mesh.face_neighbour, -1, mesh.cells()) &&
               all_below(mesh.face_partner, -1, mesh.faces()) && mesh.internal_face_count <= mesh.faces();
  // An internal face has a cell on both sides; a patch lies beyond the internal faces and within all.
  for (std::size_t f = 0; sound && f < mesh.internal_face_count; ++f) sound = mesh.face_neighbour[f] >= 0;
  const auto faces = static_cast<std::int64_t>(mesh.faces());
  for (const auto& patch : mesh.patches) {
    sound = sound && patch.first_face >= static_cast<std::int64_t>(mesh.internal_face_count) && patch.faces >= 0 &&
            patch.first_face <= faces && patch.faces <= faces - patch.first_face;
  }
  sound = sound && mesh.cells() > 0 && !mesh.points.empty();
  for (const auto& cell : mesh.cell_faces) sound = sound && all_below(cell, 0, mesh.faces());
  for (const auto& cell : mesh.cell_points) sound = sound && all_below(cell, 0, mesh.points.size());
  for (const auto& face : mesh.face_points) sound = sound && all_below(face, 0, mesh.points.size());
  if (!sound) {
    throw Failure(ExitCode::wrong_input, fmt::format("{}: the mesh is damaged; prepare the task again", file.string()))
        .at("file", file.string());
  }
}

}  // namespace

void BedMesh::write(const std::filesystem::path& file, const std::string& campaign_hash) const {
  FieldFileWriter writer(file, {.kind = "mesh", .campaign_hash = campaign_hash, .mesh_hash = ""}, flattened(points),
                         flattened(cell_points));
  HdfWriter& hdf = writer.hdf();
  hdf.write("Mesh/face_points", flattened(face_points), 4);
  hdf.write("Mesh/face_owner", face_owner);
  hdf.write("Mesh/face_neighbour", face_neighbour);
  hdf.write("Mesh/face_partner", face_partner);
  hdf.write("Mesh/cell_faces", flattened(cell_faces), 6);
  hdf.write("Mesh/cell_volume", cell_volume);
  hdf.write("Mesh/cell_centre", flattened(cell_centre), 3);
  hdf.write("Mesh/face_area", flattened(face_area), 3);
  hdf.write("Mesh/face_centre", flattened(face_centre), 3);
  hdf.write("Mesh/internal_faces", std::vector<std::int64_t>{static_cast<std::int64_t>(internal_face_count)});
  std::vector<std::int64_t> first;
  std::vector<std::int64_t> count;
  std::vector<std::int64_t> kind;
  for (const Patch& patch : patches) {
    first.push_back(patch.first_face);
    count.push_back(patch.faces);
    kind.push_back(static_cast<std::int64_t>(patch.kind));
  }
  hdf.write("Mesh/patch_first", first);
  hdf.write("Mesh/patch_faces", count);
  hdf.write("Mesh/patch_kind", kind);
  hdf.write_text("Mesh/patch_names", patch_names(patches));
  hdf.write("Mesh/periodic_depth", std::vector<double>{periodic_depth});
  writer.commit();
}

BedMesh BedMesh::read(const std::filesystem::path& file) {
  const FieldFile fields(file, "mesh");
  const HdfReader& hdf = fields.hdf();
  const auto cells = static_cast<std::int64_t>(fields.cells());
  BedMesh mesh;
  mesh.points = in_rows<3>(fields.points());
  mesh.cell_points = in_rows<8>(fields.cell_points());
  mesh.cell_faces = in_rows<6>(hdf.integers("Mesh/cell_faces", cells, 6));
  mesh.cell_volume = hdf.doubles("Mesh/cell_volume", cells, 1);
  mesh.cell_centre = in_rows<3>(hdf.doubles("Mesh/cell_centre", cells, 3));
  mesh.face_owner = hdf.integers("Mesh/face_owner", -1, 1);
  const auto faces = static_cast<std::int64_t>(mesh.face_owner.size());
  mesh.face_neighbour = hdf.integers("Mesh/face_neighbour", faces, 1);
  mesh.face_partner = hdf.integers("Mesh/face_partner", faces, 1);
  mesh.face_points = in_rows<4>(hdf.integers("Mesh/face_points", faces, 4));
  mesh.face_area = in_rows<3>(hdf.doubles("Mesh/face_area", faces, 3));
  mesh.face_centre = in_rows<3>(hdf.doubles("Mesh/face_centre", faces, 3));
  mesh.internal_face_count = static_cast<std::size_t>(hdf.integers("Mesh/internal_faces", 1, 1).front());
  mesh.patches = read_patches(hdf, file);
  mesh.periodic_depth = hdf.doubles("Mesh/periodic_depth", 1, 1).front();
  check(mesh, file);
  mesh.find_bounds();
  mesh.hash = hash_file(file);
  return mesh;
}

void BedMesh::find_bounds() {
  lower = upper = points.front();
  for (const Vector3& point : points) {
    for (std::size_t i = 0; i < 3; ++i) {
      lower[i] = std::min(lower[i], point[i]);
      upper[i] = std::max(upper[i], point[i]);
    }
  }
}

const BedMesh::Patch* BedMesh::find_patch(const std::string& name) const {
  const auto found = std::find_if(patches.begin(), patches.end(), [&](const Patch& p) { return p.name == name; });
  return found == patches.end() ? nullptr : &*found;
}

const BedMesh::Patch* BedMesh::patch_of(std::int64_t face) const {
  const auto found = std::find_if(patches.begin(), patches.end(), [&](const Patch& patch) {
    return face >= patch.first_face && face < patch.first_face + patch.faces;
  });
  return found == patches.end() ? nullptr : &*found;
}

}  // namespace cupola
