#pragma once
#include <filesystem>

#include "schemas/campaign.hpp"
#include "stage_dem/engine.hpp"

namespace cupola::test {

/// A box of `half_width` x `depth` x `height` from z = 0 with walls all round, coke parcels of 0.1 m and ore parcels of
/// 0.08 m.
Campaign box_campaign(double half_width = 0.5, double depth = 0.6, double height = 1.0);

/// The floor, the sides and (with walls) front and back of a box as triangles of at most 0.5 m.
void write_box_walls(const Campaign& campaign, const std::filesystem::path& file);

/// A fresh folder of its own for the running test, the same on every rank.
std::filesystem::path test_folder();

Parcel make_parcel(const Campaign& campaign, std::int64_t id, int species, const Vector3& position,
                   const Vector3& velocity = {});

/// All parcels of all ranks, by id.
std::vector<Parcel> everyone(const Engine& engine);

/// An engine in a fresh box.
std::unique_ptr<Engine> box_engine(const Campaign& campaign, double time_step,
                                   const std::vector<std::uint8_t>& from = {});

/// Random non-overlapping parcels of both species on a lattice in the box, `layers` high; ids from 1.
std::vector<Parcel> loose_parcels(const Campaign& campaign, int layers);

}  // namespace cupola::test
