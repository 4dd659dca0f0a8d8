#include "physics/equations/cell_failure.hpp"

#include <fmt/format.h>

namespace cupola {

Failure cell_failure(const BedMesh& mesh, const std::string& sentence, std::size_t cell) {
  const Vector3& centre = mesh.cell_centre[cell];
  return Failure(ExitCode::diverged, fmt::format("{} in cell {} at ({:.3f}, {:.3f}, {:.3f}) m", sentence, cell,
                                                 centre[0], centre[1], centre[2]))
      .at("cell", std::to_string(cell));
}

}  // namespace cupola
