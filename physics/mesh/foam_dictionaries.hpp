#pragma once
#include <filesystem>
#include <string>

#include "physics/plan/mesh_counts.hpp"
#include "schemas/campaign.hpp"

namespace cupola {

/// Writes system/: blockMeshDict, controlDict, fvSchemes, fvSolution and, for several ranks, decomposeParDict.
void write_foam_dictionaries(const std::filesystem::path& case_folder, const Campaign& campaign,
                             const MeshCounts& counts);

/// Text of system/blockMeshDict: one block between each two levels, sections and half widths; each tuyere and each
/// other opening or wall a patch of its own, made of whole block faces.
std::string block_mesh_dictionary(const Campaign& campaign, const MeshCounts& counts);

/// Head of an OpenFOAM file of a class: a dictionary, or a field such as volScalarField.
std::string foam_file_head(const std::string& object, const std::string& of_class = "dictionary");

}  // namespace cupola
