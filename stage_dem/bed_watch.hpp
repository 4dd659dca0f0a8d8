#pragma once
#include <mpi.h>

#include <set>
#include <vector>

#include "stage_dem/engine.hpp"

namespace cupola {

/// Largest overlap of two parcels over the smaller radius.  The ranks share the work; collective.
/// @param parcels all, the same on every rank
double largest_overlap(const Campaign& campaign, const std::vector<Parcel>& parcels, MPI_Comm communicator);

/// Two parcels and how deep they overlap, over the smaller radius.
struct Overlap {
  double depth = 0;
  std::size_t first = 0, second = 0;  ///< places in the list
};
/// The deepest one that a parcel of every `stride`th place, from `first` on, has with any other.
Overlap deepest_overlap(const Campaign& campaign, const std::vector<Parcel>& parcels, std::size_t first = 0,
                        std::size_t stride = 1);

/// Overlap of a parcel with the nearest wall over its radius; as below.
double wall_overlap(const Campaign& campaign, const Parcel& parcel);

/// Largest overlap of a parcel with the floor, a side wall or (where the sides are walls) front and back, over its
/// radius.  The walls go on above the mesh as the charging hopper.  Above 1 the centre is beyond the wall.
double largest_wall_overlap(const Campaign& campaign, const std::vector<Parcel>& parcels);

/// Means over the parcels of the bed (those still falling left out) of the last block's displacement over its seconds.
struct BedMotion {
  double speed = 0;       ///< m/s, mean of |u|
  double downwards = 0;   ///< m/s, mean of -u_z
  std::int64_t fast = 0;  ///< parcels faster than 5 m/s now, the falling ones included
};
BedMotion bed_motion(const std::vector<Parcel>& parcels, const std::set<std::int64_t>& falling, double seconds);

/// Whether a point lies in the bed's interior: a diameter and a half from walls, floor and surface, and outside the
/// raceways.
bool in_interior(const Campaign& campaign, const Vector3& point, double surface);

}  // namespace cupola
