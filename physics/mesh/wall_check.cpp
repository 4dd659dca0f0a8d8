#include "physics/mesh/wall_check.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <map>
#include <string>
#include <string_view>
#include <utility>

#include "schemas/failure.hpp"
#include "schemas/files.hpp"

namespace cupola {
namespace {

/// A corner in billionths of the wall's height: what is meant to be one corner is one.
using Corner = std::array<std::int64_t, 3>;

Failure wrong_walls(const std::string& name, const std::string& what) {
  return Failure(ExitCode::wrong_input,
                 fmt::format("{}: {}: prepare the task again (cupola-dem prepare writes the walls anew)", name, what))
      .at("file", name);
}

}  // namespace

std::vector<Triangle> read_stl(const std::filesystem::path& file) {
  const std::string text = read_text(file);
  constexpr std::string_view mark = "vertex";
  std::vector<Vector3> corners;
  for (auto at = text.find(mark); at != std::string::npos; at = text.find(mark, at)) {
    at += mark.size();
    Vector3 corner{};
    for (double& coordinate : corner) {
      at = std::min(text.find_first_not_of(" \t", at), text.size());
      const auto [end, error] = std::from_chars(text.data() + at, text.data() + text.size(), coordinate);
      if (error != std::errc() || !std::isfinite(coordinate))
        throw wrong_walls(file.string(), fmt::format("corner {} of a triangle is no point", corners.size() + 1));
      at = static_cast<std::size_t>(end - text.data());
    }
    corners.push_back(corner);
  }
  if (corners.empty() || corners.size() % 3 != 0)
    throw wrong_walls(file.string(), fmt::format("{} corners do not make triangles", corners.size()));
  std::vector<Triangle> triangles;
  for (std::size_t i = 0; i < corners.size(); i += 3) triangles.push_back({corners[i], corners[i + 1], corners[i + 2]});
  return triangles;
}

void check_walls(const Campaign& campaign, const std::vector<Triangle>& triangles, const std::string& name) {
  const double unit = 1e-9 * (campaign.hopper_top() - campaign.bottom());
  const auto in_units = [&](double length) { return static_cast<std::int64_t>(std::llround(length / unit)); };
  std::map<std::pair<Corner, Corner>, int> edges;
  for (const Triangle& triangle : triangles)
    for (std::size_t i = 0; i < 3; ++i) {
      std::array<Corner, 2> ends{};
      for (std::size_t end = 0; end < 2; ++end)
        for (std::size_t k = 0; k < 3; ++k) ends[end][k] = in_units(triangle[(i + end) % 3][k]);
      ++edges[std::minmax(ends[0], ends[1])];
    }
  const std::int64_t top = in_units(campaign.hopper_top());
  const std::int64_t side = in_units(campaign.scene.geometry.depth / 2);
  const bool periodic = campaign.scene.geometry.sides == Geometry::Sides::periodic;
  const auto on = [](std::int64_t a, std::int64_t b, std::int64_t plane) {
    return std::abs(a - plane) <= 1 && std::abs(b - plane) <= 1;
  };
  for (const auto& [edge, times] : edges) {
    const auto& [a, b] = edge;
    if (times > 1 || on(a[2], b[2], top)) continue;
    if (periodic && (on(a[1], b[1], side) || on(a[1], b[1], -side))) continue;
    const auto middle = [&](std::size_t k) { return 0.5 * unit * static_cast<double>(a[k] + b[k]); };
    throw wrong_walls(name, fmt::format("the wall has a hole at {:.4g} {:.4g} {:.4g} m, through which parcels would "
                                        "fall",
                                        middle(0), middle(1), middle(2)));
  }
}

}  // namespace cupola
