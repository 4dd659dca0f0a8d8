#pragma once
#include <filesystem>
#include <vector>

#include "physics/mesh/bed_mesh.hpp"
#include "schemas/campaign.hpp"
#include "stage_tracer/cell_contents.hpp"

namespace cupola {

/// What marched tracers were hotter than the steady solution on streamlines that changes as they did: what that
/// solution leaves out (layers, scatter of the grains on their way).
struct MarchBias {
  BySpecies species;  ///< K, [species][cell], smoothed; 0 where nothing was measured
};

/// Cell data of a corrected prediction that hold the bias: `march_bias.<species>`.
inline constexpr const char* march_bias_name = "march_bias.";

/// Largest bias that is carried to another flux, K: larger ones belong to where the zone stood.
inline constexpr double largest_carried_bias = 60;

/// Reads a corrected prediction's bias, limited to `largest_carried_bias`. @throws Failure
MarchBias read_march_bias(const std::filesystem::path& result, const BedMesh& mesh, const Campaign& campaign);

/// Temperatures with the bias added, K, [species][cell]: not colder than the charge, and no species that melts hotter
/// than where it melts.
BySpecies corrected(const Campaign& campaign, const CellContents& predicted, const MarchBias& bias);

}  // namespace cupola
