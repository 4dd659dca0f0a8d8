#include "physics/plan/mesh_counts.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <utility>

#include "schemas/failure.hpp"

namespace cupola {
namespace {

/// Planes nearer to each other than this share of the extent are one plane.
constexpr double same_plane = 1e-9;

void sort_and_merge(std::vector<double>& planes) {
  std::sort(planes.begin(), planes.end());
  const double tolerance = same_plane * (planes.back() - planes.front());
  std::vector<double> distinct{planes.front()};
  for (const double plane : planes) {
    if (plane - distinct.back() > tolerance) distinct.push_back(plane);
  }
  planes = std::move(distinct);
}

/// Cells of a stretch none of which is longer than `edge`.
int cells_on(double length, double edge) { return std::max(1, static_cast<int>(std::ceil(length / edge - 1e-9))); }

bool is_tuyere(const Inlet& inlet) { return inlet.side != Inlet::Side::bottom; }

std::vector<Inlet> tuyeres(const Campaign& campaign) {
  std::vector<Inlet> found;
  if (campaign.scene.gas) {
    const auto& inlets = campaign.scene.gas->inlets;
    std::copy_if(inlets.begin(), inlets.end(), std::back_inserter(found), is_tuyere);
  }
  return found;
}

Failure misplaced(const Inlet& inlet, const std::string& problem) {
  return Failure(ExitCode::wrong_input,
                 fmt::format("scene.gas.inlets: the mesh does not hold the opening of '{}': {}", inlet.name, problem))
      .at("inlet", inlet.name);
}

void check_openings(const Campaign& campaign, const std::vector<Inlet>& openings) {
  const double bottom = campaign.bottom();
  const double top = campaign.top();
  const double depth = campaign.scene.geometry.depth;
  for (std::size_t i = 0; i < openings.size(); ++i) {
    const Inlet& inlet = openings[i];
    const double lower = inlet.z - inlet.size[1] / 2;
    const double upper = inlet.z + inlet.size[1] / 2;
    if (!(inlet.size[0] > 0) || !(inlet.size[1] > 0)) throw misplaced(inlet, "both sizes must be above zero");
    if (lower < bottom - same_plane * (top - bottom) || upper > top + same_plane * (top - bottom)) {
      throw misplaced(inlet,
                      fmt::format("it reaches from z = {} m to {} m, the side wall from {} m to {} m; move it or "
                                  "extend scene.geometry's profile",
                                  lower, upper, bottom, top));
    }
    if (inlet.size[0] > depth * (1 + same_plane)) {
      throw misplaced(inlet, fmt::format("it is {} m wide, the slot {} m deep", inlet.size[0], depth));
    }
    for (std::size_t k = 0; k < i; ++k) {
      const Inlet& other = openings[k];
      const double gap = std::abs(inlet.z - other.z) - (inlet.size[1] + other.size[1]) / 2;
      if (inlet.side == other.side && gap < -same_plane * (top - bottom)) {
        throw misplaced(inlet, fmt::format("it overlaps '{}' on the same wall", other.name));
      }
    }
  }
}

double mean_half_width(const Campaign& campaign) {
  const double bottom = campaign.bottom();
  const double top = campaign.top();
  return slot_volume(campaign, bottom, top) / (2 * campaign.scene.geometry.depth * (top - bottom));
}

/// Shares `count` cells out over the stretches between planes so that the longest edge is as short as can be.
std::vector<int> share_out(const std::vector<double>& planes, std::size_t first, std::size_t last, int count) {
  std::vector<int> cells(last - first, 1);
  const auto edge = [&](std::size_t i) { return (planes[first + i + 1] - planes[first + i]) / cells[i]; };
  for (int left = count - static_cast<int>(cells.size()); left > 0; --left) {
    std::size_t longest = 0;
    for (std::size_t i = 1; i < cells.size(); ++i) {
      if (edge(i) > edge(longest) * (1 + 1e-9)) longest = i;
    }
    ++cells[longest];
  }
  return cells;
}

Failure too_few(const std::string& key, int count, std::size_t needed) {
  return Failure(ExitCode::wrong_input,
                 fmt::format("scene.mesh.cells.{}: {} cells cannot hold the {} stretches between tuyere edges, profile "
                             "corners and stock line; give at least {}",
                             key, count, needed, needed));
}

/// Stated counts of the rows, a section of the profile at a time.
std::vector<int> stated_rows(const Campaign& campaign, const std::vector<double>& levels) {
  const auto& profile = campaign.scene.geometry.profile;
  const auto& heights = campaign.scene.mesh.cells->heights;
  if (heights.size() + 1 != profile.size()) {
    throw Failure(ExitCode::wrong_input,
                  fmt::format("scene.mesh.cells.heights: {} counts for {} sections of the profile", heights.size(),
                              profile.size() - 1));
  }
  std::vector<int> rows;
  std::size_t first = 0;
  for (std::size_t section = 0; section < heights.size(); ++section) {
    std::size_t last = first;
    while (last + 1 < levels.size() && levels[last + 1] < profile[section + 1][0] + same_plane) ++last;
    if (heights[section] < static_cast<int>(last - first)) {
      throw too_few(fmt::format("heights[{}]", section), heights[section], last - first);
    }
    const std::vector<int> cells = share_out(levels, first, last, heights[section]);
    rows.insert(rows.end(), cells.begin(), cells.end());
    first = last;
  }
  return rows;
}

std::vector<int> even_cells(const std::vector<double>& planes, double edge) {
  std::vector<int> cells;
  for (std::size_t i = 1; i < planes.size(); ++i) cells.push_back(cells_on(planes[i] - planes[i - 1], edge));
  return cells;
}

}  // namespace

std::size_t MeshCounts::rows_in_all() const { return std::accumulate(rows.begin(), rows.end(), std::size_t{0}); }

std::size_t MeshCounts::slices_in_all() const { return std::accumulate(slices.begin(), slices.end(), std::size_t{0}); }

std::size_t MeshCounts::cells() const {
  return 2 * static_cast<std::size_t>(columns) * slices_in_all() * rows_in_all();
}

double slot_volume(const Campaign& campaign, double from, double to) {
  std::vector<double> heights{from, to};
  for (const auto& corner : campaign.scene.geometry.profile) {
    if (corner[0] > from && corner[0] < to) heights.push_back(corner[0]);
  }
  std::sort(heights.begin(), heights.end());
  double area = 0;
  for (std::size_t i = 1; i < heights.size(); ++i) {
    area += (heights[i] - heights[i - 1]) * (campaign.half_width(heights[i]) + campaign.half_width(heights[i - 1]));
  }
  return area * campaign.scene.geometry.depth;
}

MeshCounts mesh_counts(const Campaign& campaign) {
  const Geometry& geometry = campaign.scene.geometry;
  const std::vector<Inlet> openings = tuyeres(campaign);
  check_openings(campaign, openings);

  MeshCounts counts;
  for (const auto& corner : geometry.profile) counts.levels.push_back(corner[0]);
  counts.sections = {-geometry.depth / 2, geometry.depth / 2};
  for (const Inlet& inlet : openings) {
    for (const int sign : {-1, 1}) {
      counts.levels.push_back(inlet.z + sign * inlet.size[1] / 2);
      counts.sections.push_back(sign * inlet.size[0] / 2);
    }
  }
  const double stock_line = campaign.charging.stock_line;
  if (stock_line > campaign.bottom() && stock_line < campaign.top()) counts.levels.push_back(stock_line);
  sort_and_merge(counts.levels);
  sort_and_merge(counts.sections);

  if (const auto& stated = campaign.scene.mesh.cells) {
    const std::size_t stretches = counts.sections.size() - 1;
    if (stated->depth < static_cast<int>(stretches)) throw too_few("depth", stated->depth, stretches);
    counts.rows = stated_rows(campaign, counts.levels);
    counts.slices = share_out(counts.sections, 0, stretches, stated->depth);
    counts.columns = stated->half_width;
  } else {
    const double cell = campaign.scene.mesh.cell;
    counts.rows = even_cells(counts.levels, cell);
    counts.slices = even_cells(counts.sections, cell);
    counts.columns = cells_on(mean_half_width(campaign), cell);
  }
  return counts;
}

}  // namespace cupola
