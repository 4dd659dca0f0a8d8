#include "physics/mesh/foam_dictionaries.hpp"

#include <fmt/format.h>

#include <limits>

#include "physics/mesh/foam_turbulence.hpp"
#include "schemas/files.hpp"

namespace cupola {
namespace {

std::string control_dictionary() {
  // Binary, so that no digit of a coordinate is lost on the way from blockMesh to the solvers.
  return foam_file_head("controlDict") +
         R"(application       cupola;
startFrom         startTime;
startTime         0;
stopAt            endTime;
endTime           1;
deltaT            1;
writeControl      timeStep;
writeInterval     1;
writeFormat       binary;
writePrecision    17;
writeCompression  off;
timeFormat        general;
timePrecision     6;
runTimeModifiable no;
)";
}

std::string schemes_dictionary(const Campaign& campaign) {
  return foam_file_head("fvSchemes") +
         fmt::format("ddtSchemes           {{ default {}; }}\n", has_turbulence(campaign) ? "Euler" : "steadyState") +
         R"(gradSchemes          { default Gauss linear; }
divSchemes           { default Gauss upwind; }
laplacianSchemes     { default Gauss linear corrected; }
interpolationSchemes { default linear; }
snGradSchemes        { default corrected; }
)";
}

std::string solution_dictionary() {
  return foam_file_head("fvSolution") +
         R"foam(solvers
{
    // Pressure-like: symmetric, elliptic.
    "(psi|potential)"
    {
        solver                GAMG;
        smoother              GaussSeidel;
        tolerance             1e-12;
        relTol                1e-6;
        nCellsInCoarsestLevel 20;
        maxIter               200;
    }
    // Upwind convection with conduction: not symmetric.
    "(T|k|epsilon)"
    {
        solver         PBiCGStab;
        preconditioner DILU;
        tolerance      1e-12;
        relTol         1e-8;
        maxIter        1000;
    }
}
)foam";
}

/// Parts along x and z, nx * nz = ranks, with the least area between them.
struct Parts {
  int across = 1;
  int up = 1;
};

Parts best_parts(const Campaign& campaign, int ranks) {
  const double height = campaign.top() - campaign.bottom();
  const double width =
      slot_volume(campaign, campaign.bottom(), campaign.top()) / (height * campaign.scene.geometry.depth);
  Parts best;
  double least = std::numeric_limits<double>::max();
  for (int across = 1; across <= ranks; ++across) {
    if (ranks % across != 0) continue;
    const int up = ranks / across;
    const double cut = (across - 1) * height + (up - 1) * width;
    if (cut < least) {
      least = cut;
      best = {across, up};
    }
  }
  return best;
}

std::string decomposition_dictionary(const Campaign& campaign) {
  const Parts parts = best_parts(campaign, campaign.launch.ranks);
  return foam_file_head("decomposeParDict") +
         fmt::format(
             "numberOfSubdomains {};\nmethod hierarchical;\nhierarchicalCoeffs\n{{\n    n ({} 1 {});\n"
             "    delta 0.001;\n    order zxy;\n}}\n",
             campaign.launch.ranks, parts.across, parts.up);
}

}  // namespace

std::string foam_file_head(const std::string& object, const std::string& of_class) {
  return fmt::format("FoamFile\n{{\n    version 2.0;\n    format ascii;\n    class {};\n    object {};\n}}\n\n",
                     of_class, object);
}

void write_foam_dictionaries(const std::filesystem::path& case_folder, const Campaign& campaign,
                             const MeshCounts& counts) {
  const std::filesystem::path system = case_folder / "system";
  std::filesystem::create_directories(system);
  write_text_atomically(system / "blockMeshDict", block_mesh_dictionary(campaign, counts));
  write_text_atomically(system / "controlDict", control_dictionary());
  write_text_atomically(system / "fvSchemes", schemes_dictionary(campaign));
  if (has_turbulence(campaign)) write_foam_turbulence(case_folder, campaign);
  write_text_atomically(system / "fvSolution", solution_dictionary());
  if (campaign.launch.ranks > 1) {
    write_text_atomically(system / "decomposeParDict", decomposition_dictionary(campaign));
  }
}

}  // namespace cupola
