#pragma once
#include <cstdint>
#include <vector>

#include "physics/motion/path.hpp"

namespace cupola {

/// Grains that follow the granular field without colliding: one tracer stands for a fixed material volume
/// (mass/density) of one species.  A tracer belongs to one rank for life (`rank_of`).  The order is of no meaning; it
/// follows the cells from time to time (`sort_by_cell`), so that neighbours in memory use the same values of cells.
struct Tracers {
  std::vector<std::int64_t> id;
  std::vector<std::uint8_t> species;  ///< index in Campaign::species
  std::vector<PathField::Point> point;
  std::vector<double> volume;       ///< m3, material
  std::vector<double> life;         ///< what is left of the tracer's exponential life in the raceways, 1
  std::vector<double> temperature;  ///< K; empty in a scene without heat

  [[nodiscard]] std::size_t size() const { return id.size(); }

  void add(std::int64_t new_id, std::uint8_t new_species, const PathField::Point& where, double new_volume,
           double new_life) {
    id.push_back(new_id);
    species.push_back(new_species);
    point.push_back(where);
    volume.push_back(new_volume);
    life.push_back(new_life);
  }

  /// Drops the tracers for which `drop[i]` is not 0, keeping the order of the others.
  void remove(const std::vector<std::uint8_t>& drop);

  /// Puts them in the order of their cells; within a cell the order is kept.
  void sort_by_cell(std::size_t cells);
};

/// Id of tracer j of a parcel: parcel id * 1000 + j.
inline constexpr std::int64_t tracer_ids_per_parcel = 1000;

/// The rank a tracer belongs to: tracers of one parcel, and parcels with ids in a row, are dealt out in turn.
inline int rank_of(std::int64_t id, int ranks) {
  return static_cast<int>((id / tracer_ids_per_parcel + id % tracer_ids_per_parcel) % ranks);
}

/// A tracer as a row of numbers, for messages between ranks and checkpoints: id, species, cell, reference point (3),
/// volume, life, temperature (0 without heat).
inline constexpr std::size_t tracer_columns = 9;
std::vector<double> to_rows(const Tracers& tracers);
/// Of `rows` those that belong to this rank, in the order of the rows.
Tracers from_rows(const std::vector<double>& rows, bool heat, int rank, int ranks);

/// The exponentially distributed life, mean 1, of a tracer: it is removed when the integral of the removal rate along
/// its path reaches it.
double draw_life(std::uint64_t seed, std::int64_t id);

}  // namespace cupola
