#pragma once
#include <filesystem>
#include <string>

#include "schemas/campaign.hpp"

namespace cupola {

/// Whether the DEM stage's gas has a turbulence model.
bool has_turbulence(const Campaign& campaign);

/// OpenFOAM's name of a model.
std::string foam_turbulence_model(TransientGas::Turbulence model);

/// Fluctuations of the blast over its velocity.
inline constexpr double inlet_intensity = 0.05;
/// 0.07 hydraulic diameters of the opening, m.
double inlet_mixing_length(const Campaign& campaign, const Inlet& inlet);

/// What the gas begins with: k and epsilon of the inlets at the superficial speed of the whole blast.
struct InitialTurbulence {
  double k = 0, epsilon = 0;  ///< m2/s2, m2/s3
};
InitialTurbulence initial_turbulence(const Campaign& campaign);

/// Writes what OpenFOAM's models want to read: constant/turbulenceProperties and the fields k, epsilon and nut of
/// time 0.
void write_foam_turbulence(const std::filesystem::path& case_folder, const Campaign& campaign);

}  // namespace cupola
