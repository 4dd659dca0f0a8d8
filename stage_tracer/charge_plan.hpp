#pragma once
#include <cstddef>
#include <vector>

#include "schemas/campaign.hpp"

namespace cupola {

/// The charge as a stream of solids: the layers of the recipe, repeated, pass the stock plane at a constant volume flow
/// (MODEL 3). Where the stream stands is a volume: the solids that have passed since the beginning of the first layer,
/// modulo the cycle.
///
/// Where layers are laid in rings, the plane has zones with a recipe of their own each: every layer brings its whole
/// volume, every zone takes what its flow takes in a cycle (so the surface stays level: where a ring lies, the other
/// layers are thinner), and within that the layers are as even as can be (iterative proportional fitting).
class ChargePlan {
 public:
  /// A part of the stock plane.
  struct Place {
    double distance = 0;     ///< m, |x|
    double volume_rate = 0;  ///< m3/s
  };

  /// @param solids_volume_rate material volume of all species, m3/s, positive
  /// @param position volume of the recipe that has passed at time 0, m3 (any real number)
  /// @param places of the stock plane; needed where a layer has a ring
  /// @throws Failure wrong_input: no layer, a layer without mass, a ring without a place or too narrow for its layers
  ChargePlan(const Campaign& campaign, double solids_volume_rate, double position,
             const std::vector<Place>& places = {});

  /// Zone of each place, as given.
  [[nodiscard]] const std::vector<std::size_t>& zone_of_place() const { return zone_of_place_; }
  [[nodiscard]] std::size_t zones() const { return end_.size(); }

  /// A time interval in which one layer passes.
  struct Piece {
    double from = 0, to = 0;  ///< s
    std::size_t layer = 0;
    const std::vector<double>* share = nullptr;  ///< of each species in the volume; sums to 1
  };
  /// The pieces of [from, to] in a zone, in order, without gaps.
  [[nodiscard]] std::vector<Piece> pieces(double from, double to, std::size_t zone = 0) const;

  [[nodiscard]] double volume_rate() const { return rate_; }             ///< m3/s
  [[nodiscard]] double cycle_volume() const { return cycle_; }           ///< m3
  [[nodiscard]] double cycle_seconds() const { return cycle_ / rate_; }  ///< one layer passage
  [[nodiscard]] double thinnest_layer_seconds() const;

 private:
  void divide_into_zones(const Campaign& campaign, const std::vector<double>& volume, const std::vector<Place>& places);

  double rate_;
  double position_;
  double cycle_ = 0;
  std::vector<std::size_t> zone_of_place_;
  std::vector<std::vector<double>> end_;    ///< zones x layers: from the cycle's beginning to each layer's end, m3 of
                                            ///< the whole plane
  std::vector<std::vector<double>> share_;  ///< layers x species
};

}  // namespace cupola
