#pragma once
#include <filesystem>
#include <vector>

#include "physics/mesh/wall_triangles.hpp"

namespace cupola {

/// The triangles of an ASCII STL file. @throws Failure input_output; wrong_input where a triangle is not whole
std::vector<Triangle> read_stl(const std::filesystem::path& file);

/// Walls hold the bed only where they have no hole: every edge belongs to two triangles, but for those of the open top
/// (of the hopper) and of periodic front and back.
/// @param name of the file they are from, for the sentence
/// @throws Failure wrong_input that says where the hole is
void check_walls(const Campaign& campaign, const std::vector<Triangle>& triangles, const std::string& name);

}  // namespace cupola
