#pragma once
#include <array>
#include <filesystem>
#include <vector>

#include "schemas/campaign.hpp"

namespace cupola {

using Triangle = std::array<Vector3, 3>;

/// What grains lean on, as triangles with edges of at most 0.5 m, seen from outside against the clock: the side walls
/// (closed over the tuyeres, through which no grain leaves) and the bottom, front and back where they are walls, and
/// the same walls continued upwards by the charging hopper.  Open at the top and at periodic sides.
std::vector<Triangle> wall_triangles(const Campaign& campaign);

/// Writes them as an ASCII STL file. @throws Failure input_output
void write_stl(const std::filesystem::path& file, const std::vector<Triangle>& triangles);

}  // namespace cupola
