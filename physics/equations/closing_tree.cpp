#include "physics/equations/closing_tree.hpp"

#include "physics/equations/face_geometry.hpp"

namespace cupola {

ClosingTree::ClosingTree(const BedMesh& mesh, const std::function<bool(std::size_t face)>& open) : mesh_(mesh) {
  std::vector<bool> reached(mesh.cells(), false);
  branches_.reserve(mesh.cells());
  for (std::size_t face = mesh.internal_faces(); face < mesh.faces(); ++face) {
    const std::int64_t owner = mesh.face_owner[face];
    if (mesh.face_neighbour[face] >= 0 || !open(face) || reached[owner]) continue;
    reached[owner] = true;
    branches_.push_back({static_cast<std::int32_t>(owner), static_cast<std::int32_t>(face), -1});
  }
  for (std::size_t next = 0; next < branches_.size(); ++next) {
    const std::int32_t cell = branches_[next].cell;
    for (const std::int64_t face : mesh.cell_faces[cell]) {
      if (static_cast<std::size_t>(face) >= mesh.internal_faces()) continue;
      const std::int64_t other = mesh.across(cell, face);
      if (reached[other]) continue;
      reached[other] = true;
      branches_.push_back({static_cast<std::int32_t>(other), static_cast<std::int32_t>(face), cell});
    }
  }
}

void ClosingTree::close(std::vector<double>& face_flux) const {
  std::vector<double> left = FaceGeometry::outflow(mesh_, face_flux);
  for (auto branch = branches_.rbegin(); branch != branches_.rend(); ++branch) {
    const double excess = left[branch->cell];
    const bool owns = mesh_.face_owner[branch->face] == branch->cell;
    face_flux[branch->face] -= owns ? excess : -excess;
    if (branch->beyond >= 0) left[branch->beyond] += excess;
  }
}

}  // namespace cupola
