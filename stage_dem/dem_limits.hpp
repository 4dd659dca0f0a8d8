#pragma once
#include "schemas/campaign.hpp"

namespace cupola {

/// Checks against `dem.limits`.  Overlaps and creep are what a time step or a stiffness gone too far shows first: the
/// throughput of a bed changes with them long before anything diverges.

/// Sinking of the bed at rest over its descent in the DEM stage, which is `descent_rate` times the speed-up of the
/// removal; 0 where nothing descends.
double creep_over_descent(const Campaign& campaign, double creep_speed);

/// @throws Failure diverged with advice where an overlap (of two parcels over the smaller radius, of a parcel and a
/// wall over its radius) exceeds its limit
void check_overlaps(const Campaign& campaign, double overlap, double wall_overlap, long step);

/// @throws Failure diverged with advice where the bed at rest sinks faster than the limit allows
void check_creep(const Campaign& campaign, double creep_speed, long step);

}  // namespace cupola
