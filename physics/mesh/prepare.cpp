#include "physics/mesh/prepare.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <numeric>
#include <set>
#include <sstream>

#include "physics/mesh/bed_mesh.hpp"
#include "physics/mesh/foam_dictionaries.hpp"
#include "physics/mesh/foam_tool.hpp"
#include "physics/mesh/foam_turbulence.hpp"
#include "physics/mesh/mesh_from_foam.hpp"
#include "physics/mesh/wall_triangles.hpp"
#include "physics/plan/mesh_counts.hpp"
#include "schemas/files.hpp"
#include "schemas/version.hpp"

namespace cupola {
namespace {

/// Parcels must not touch their own periodic images: two diameters and what LIGGGHTS' neighbour lists look ahead.
constexpr double least_depth_in_diameters = 2.1;

void check_depth(const Campaign& campaign) {
  if (campaign.scene.geometry.sides != Geometry::Sides::periodic) return;
  double largest = 0;
  for (const Species& species : campaign.species) largest = std::max(largest, species.parcel_diameter());
  if (campaign.scene.geometry.depth < least_depth_in_diameters * largest) {
    throw Failure(ExitCode::wrong_input,
                  fmt::format("scene.geometry.slot.depth: {} m is too shallow for periodic sides and parcels of {} m; "
                              "at least {} m, or a smaller coarse_graining",
                              campaign.scene.geometry.depth, largest, least_depth_in_diameters * largest))
        .at("key", "scene.geometry.slot.depth");
  }
}

void check_inlet_names(const Campaign& campaign) {
  if (!campaign.scene.gas) return;
  std::set<std::string> taken{"wall", "bottom", "outlet", "front", "back"};
  for (const Inlet& inlet : campaign.scene.gas->inlets) {
    const bool plain = !inlet.name.empty() && std::all_of(inlet.name.begin(), inlet.name.end(), [](unsigned char c) {
      return std::isalnum(c) != 0 || c == '-' || c == '_';
    });
    if (!plain || !taken.insert(inlet.name).second) {
      throw Failure(
          ExitCode::wrong_input,
          fmt::format("scene.gas.inlets: '{}' cannot name an inlet: letters, digits, - and _, each name once, "
                      "and none of wall, bottom, outlet, front, back",
                      inlet.name))
          .at("inlet", inlet.name);
    }
  }
}

/// What checkMesh marks with asterisks, on one line.
std::string marked_lines(const std::string& printed) {
  std::istringstream lines(printed);
  std::string found;
  for (std::string line; std::getline(lines, line);)
    if (const auto mark = line.find("***"); mark != std::string::npos)
      found += (found.empty() ? "" : "; ") + line.substr(line.find_first_not_of('*', mark));
  return found;
}

void check_mesh(const std::filesystem::path& case_folder) {
  const std::string printed = run_foam_tool("checkMesh", {"-constant"}, case_folder);
  if (printed.find("Mesh OK") == std::string::npos) {
    const std::filesystem::path log = case_folder / "log.checkMesh";
    if (printed.find("Failed ") == std::string::npos) {
      throw Failure(ExitCode::input_output,
                    fmt::format("{}: checkMesh did not come to a verdict: is the disk full? Run again", log.string()))
          .at("file", log.string());
    }
    throw Failure(ExitCode::wrong_input,
                  fmt::format("checkMesh finds the mesh wanting ({}; an aspect ratio of 1000 is its limit; see {}): "
                              "cells too flat, or walls too steep for scene.mesh.cell; change it, or the profile",
                              marked_lines(printed), log.string()))
        .at("key", "scene.mesh");
  }
}

/// Area of an opening in a side wall whose half width changes with height, m2.
double opening_area(const Campaign& campaign, const Inlet& inlet) {
  std::vector<double> heights{inlet.z - inlet.size[1] / 2, inlet.z + inlet.size[1] / 2};
  for (const auto& corner : campaign.scene.geometry.profile) {
    if (corner[0] > heights[0] && corner[0] < heights[1]) heights.push_back(corner[0]);
  }
  std::sort(heights.begin(), heights.end());
  double length = 0;
  for (std::size_t i = 1; i < heights.size(); ++i) {
    length +=
        std::hypot(heights[i] - heights[i - 1], campaign.half_width(heights[i]) - campaign.half_width(heights[i - 1]));
  }
  return length * inlet.size[0];
}

double patch_area(const BedMesh& mesh, const BedMesh::Patch& patch) {
  double area = 0;
  for (std::int64_t i = patch.first_face; i < patch.first_face + patch.faces; ++i) {
    const Vector3& a = mesh.face_area[static_cast<std::size_t>(i)];
    area += std::hypot(a[0], a[1], a[2]);
  }
  return area;
}

/// The mesh is the one that was wanted: cells, volume and openings.
void check_against_plan(const BedMesh& mesh, const Campaign& campaign, const MeshCounts& counts) {
  const double wanted = slot_volume(campaign, campaign.bottom(), campaign.top());
  const double volume = std::accumulate(mesh.cell_volume.begin(), mesh.cell_volume.end(), 0.0);
  if (mesh.cells() != counts.cells() || !(std::abs(volume - wanted) <= 1e-9 * wanted)) {
    throw Failure(ExitCode::wrong_input, fmt::format("the mesh has {} cells and {} m3 instead of {} and {}",
                                                     mesh.cells(), volume, counts.cells(), wanted));
  }
  if (!campaign.scene.gas) return;
  for (const Inlet& inlet : campaign.scene.gas->inlets) {
    const BedMesh::Patch* patch = mesh.find_patch(inlet.name);
    const double area = inlet.side == Inlet::Side::bottom
                            ? 2 * campaign.half_width(campaign.bottom()) * campaign.scene.geometry.depth
                            : opening_area(campaign, inlet);
    if (patch == nullptr || !(std::abs(patch_area(mesh, *patch) - area) <= 1e-9 * area)) {
      throw Failure(
          ExitCode::wrong_input,
          fmt::format("scene.gas.inlets: the mesh does not hold the opening of '{}' ({} m2)", inlet.name, area))
          .at("inlet", inlet.name);
    }
  }
}

/// What `foam/` was prepared for.
nlohmann::json purpose(const Task& task, const MeshCounts& counts) {
  return {{"campaign_hash", task.campaign_hash},
          {"program_version", task.program_version},
          {"ranks", task.campaign.launch.ranks},
          {"hopper_top", task.campaign.hopper_top()},
          {"blocks", hash_text(block_mesh_dictionary(task.campaign, counts))}};
}

}  // namespace

void prepare(const std::filesystem::path& task_folder, const Task& task) {
  const std::filesystem::path folder = std::filesystem::absolute(task_folder);
  const Campaign& campaign = task.campaign;
  check_depth(campaign);
  check_inlet_names(campaign);
  const MeshCounts counts = mesh_counts(campaign);
  const nlohmann::json wanted = purpose(task, counts);
  const std::filesystem::path stamp = folder / "foam" / "prepared.json";
  if (std::filesystem::exists(stamp) && read_json(stamp) == wanted) return;

  const std::filesystem::path building = folder / "foam.partial";
  std::filesystem::remove_all(building);
  std::filesystem::create_directories(building);
  write_foam_dictionaries(building, campaign, counts);
  run_foam_tool("blockMesh", {}, building);
  check_mesh(building);
  const BedMesh mesh = mesh_from_foam(building, campaign);
  check_against_plan(mesh, campaign, counts);
  mesh.write(building / "mesh.hdf", task.campaign_hash);
  write_stl(building / "wall.stl", wall_triangles(campaign));
  if (campaign.launch.ranks > 1) {
    // The mesh alone, or with the fields that a turbulence model reads.
    const std::vector<std::string> what =
        has_turbulence(campaign) ? std::vector<std::string>{"-time", "0"} : std::vector<std::string>{"-constant"};
    run_foam_tool("decomposePar", what, building);
  }
  write_json_atomically(building / "prepared.json", wanted);

  std::filesystem::remove_all(folder / "foam");
  publish(building, folder / "foam");
}

}  // namespace cupola
