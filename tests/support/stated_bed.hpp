#pragma once
#include <cstdint>
#include <filesystem>
#include <vector>

#include "physics/mesh/bed_mesh.hpp"
#include "schemas/task.hpp"

namespace cupola::testing {

/// A DEM result that a test states instead of computing it.
struct StatedBed {
  std::vector<double> solids_fraction;    ///< all cells
  std::vector<Vector3> solids_velocity;   ///< m/s at DEM speed, all cells
  std::vector<std::int64_t> id, species;  ///< of the parcels
  std::vector<Vector3> position;
  std::vector<double> radius, mass;
  double coke_removal_rate = 0;  ///< kg/s
  std::vector<double> removal_by_raceway;

  void add_parcel(std::int64_t of_species, const Vector3& where, double with_radius, double with_mass);
};

/// Solids at rest: one parcel in the middle of each cell below the stock line, of the cell's share of
/// `solids_fraction`.
StatedBed bed_at_rest(const BedMesh& mesh, const Campaign& campaign, double solids_fraction);

/// Writes it as the DEM stage writes its result.
void write_stated_bed(const std::filesystem::path& file, const BedMesh& mesh, const Task& task, const StatedBed& bed);

}  // namespace cupola::testing
