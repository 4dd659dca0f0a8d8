#pragma once
#include <cstdint>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "physics/mesh/bed_mesh.hpp"
#include "schemas/campaign.hpp"

namespace cupola {

/// Parcels of the last DEM packing, sorted by id.
struct Packing {
  std::vector<std::int64_t> id;
  std::vector<std::uint8_t> species;  ///< index in Campaign::species
  std::vector<Vector3> position;      ///< m
  std::vector<double> radius;         ///< m, contact radius
  std::vector<double> mass;           ///< kg
};

/// What the tracer stage reads of a DEM result (docs/contracts.md); arrays over all cells.
struct DemResult {
  std::vector<double> solids_fraction;   ///< material volume fraction
  std::vector<double> solids_growth;     ///< 1/s: its change in the window
  std::vector<double> contact_fraction;  ///< contact volume fraction
  std::vector<Vector3> solids_velocity;  ///< m/s, at DEM speed
  Packing packing;
  std::size_t next_layer = 0;
  std::vector<double> owed;                ///< kg a species not yet charged of the running layer
  double persistent_removal_rate = 0;      ///< kg/s, `coke_removal_rate`
  std::vector<double> removal_by_raceway;  ///< kg/s
};

/// @throws Failure wrong_input: of another mesh, a field that is missing, too short or not finite, no parcel;
/// input_output
DemResult read_dem_result(const std::filesystem::path& file, const BedMesh& mesh, const Campaign& campaign);

}  // namespace cupola
