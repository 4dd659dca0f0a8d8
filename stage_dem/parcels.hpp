#pragma once
#include <mpi.h>

#include <vector>

#include "stage_dem/engine.hpp"

namespace cupola {

/// All parcels of all ranks, by id, on every rank: what decides about parcels works on this list and so decides the
/// same everywhere.
std::vector<Parcel> gather_parcels(const Engine& engine, MPI_Comm communicator);

/// A new parcel of a species at rest, unsoftened.
Parcel new_parcel(const Campaign& campaign, std::int64_t id, int species, const Vector3& position);

/// Mass of a parcel of a species, kg.
double parcel_mass(const Species& species);

/// Diameter of the largest unsoftened parcel, m.
double largest_diameter(const Campaign& campaign);

/// Period along y, m; 0 where the sides are walls.
double period(const Campaign& campaign);

/// Contact volume 4/3 pi r^3, m3.
double contact_volume(const Parcel& parcel);

/// Material volume m/rho, m3 (MODEL 5).
double material_volume(const Campaign& campaign, const Parcel& parcel);

}  // namespace cupola
