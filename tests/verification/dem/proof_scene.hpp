#pragma once
#include <functional>
#include <vector>

#include "physics/plan/dem_time_step.hpp"
#include "stage_dem/engine.hpp"
#include "stage_dem/parcels.hpp"
#include "tests/unit/dem/box_scene.hpp"

namespace cupola::test {

/// The box of `box_scene.hpp` with one species of grains as they are; no rolling friction.
Campaign one_species(double diameter, double density);

/// A new parcel with a velocity.
Parcel new_parcel(const Campaign& campaign, std::int64_t id, int species, const Vector3& position,
                  const Vector3& velocity);

/// Advances by `steps` again and again until the condition holds for all parcels by id; fails the test where it never
/// does.
void advance_until(Engine& engine, long steps, const std::function<bool(const std::vector<Parcel>&)>& condition);

/// Random parcels of the campaign's species in turns, up to a height, that touch nothing.
std::vector<Parcel> poured(const Campaign& campaign, double height, std::size_t at_most = 1000000);

/// Share of a block's volume inside parcels, by a lattice of points (error about 1e-3 for some dozen parcels); y is
/// periodic with the campaign's period.
double packing_fraction(const Campaign& campaign, const std::vector<Parcel>& parcels, const Vector3& lower,
                        const Vector3& upper);

}  // namespace cupola::test
