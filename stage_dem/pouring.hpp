#pragma once
#include <functional>
#include <vector>

#include "stage_dem/engine.hpp"
#include "stage_dem/neighbour_grid.hpp"
#include "stage_dem/random_numbers.hpp"

namespace cupola {

/// Random sequential insertion of parcels in the room above the bed: each is put at random where it touches nothing.
class Pouring {
 public:
  /// Solids fraction that random insertion fills quickly.
  static constexpr double loose_fraction = 0.22;

  /// @param present parcels that are there already
  Pouring(const Campaign& campaign, const std::vector<Parcel>& present);

  /// Tries random places between two heights for a parcel of the species that `choose` wants there (-1: none); gives up
  /// after `attempts`.
  /// @return whether a place was found; the parcel is in `placed`
  bool place(double from, double to, std::int64_t id, const std::function<int(double x)>& choose, RandomNumbers& random,
             int attempts);

  [[nodiscard]] const std::vector<Parcel>& placed() const { return placed_; }

  /// Largest |x| of the centre of a sphere that touches no side wall, m; negative where there is no room.
  static double room(const Campaign& campaign, double z, double radius);

 private:
  [[nodiscard]] bool free(const Vector3& position, double radius) const;

  const Campaign& campaign_;
  NeighbourGrid grid_;
  std::vector<double> radius_;
  std::vector<Parcel> placed_;
};

}  // namespace cupola
