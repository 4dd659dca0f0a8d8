#pragma once
#include <vector>

#include "stage_dem/engine.hpp"

namespace cupola {

/// Largest growth of a radius between two short runs while a parcel regrows (MODEL 5).
inline constexpr double regrowth_per_run = 0.002;

/// Contact radius for a volume factor: r0 f_eff^(-1/3), m.
double softened_radius(const Species& species, double factor);

/// The volume factor a parcel has: (r0/r)^3.
double present_factor(const Campaign& campaign, const Parcel& parcel);

/// Radius after the ore's temperature at the parcel has been seen: f_eff follows eq. 6 of seed 001 and never falls.
/// Species that do not soften keep their radius.
double soften(const Campaign& campaign, const Parcel& parcel, double temperature);

/// Radius on the way back after an update of the cohesive zone: at most `regrowth_per_run` larger, up to what the
/// temperature allows.
double regrow(const Campaign& campaign, const Parcel& parcel, double temperature);

/// Whether the parcel has melted.
bool melted(const Campaign& campaign, const Parcel& parcel, double temperature);

}  // namespace cupola
