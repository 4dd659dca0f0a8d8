#pragma once
#include <cstddef>
#include <vector>

#include "schemas/campaign.hpp"

namespace cupola {

/// The charge as a stream of solids: the layers of the recipe, repeated, pass the stock plane at a constant volume flow
/// (MODEL 3). Where the stream stands is a volume: the solids that have passed since the beginning of the first layer,
/// modulo the cycle.
class ChargePlan {
 public:
  /// @param solids_volume_rate material volume of all species, m3/s, positive
  /// @param position volume of the recipe that has passed at time 0, m3 (any real number)
  /// @throws Failure wrong_input: no layer, or a layer without mass
  ChargePlan(const Campaign& campaign, double solids_volume_rate, double position);

  /// A time interval in which one layer passes.
  struct Piece {
    double from = 0, to = 0;  ///< s
    std::size_t layer = 0;
    const std::vector<double>* share = nullptr;  ///< of each species in the volume; sums to 1
  };
  /// The pieces of [from, to], in order, without gaps.
  [[nodiscard]] std::vector<Piece> pieces(double from, double to) const;

  [[nodiscard]] double volume_rate() const { return rate_; }                  ///< m3/s
  [[nodiscard]] double cycle_volume() const { return end_.back(); }           ///< m3
  [[nodiscard]] double cycle_seconds() const { return end_.back() / rate_; }  ///< one layer passage
  [[nodiscard]] double thinnest_layer_seconds() const;
  /// Volume from the cycle's beginning to the beginning of a layer, m3.
  [[nodiscard]] double layer_begin(std::size_t layer) const { return layer == 0 ? 0 : end_[layer - 1]; }

 private:
  double rate_;
  double position_;
  std::vector<double> end_;                 ///< volume from the cycle's beginning to each layer's end
  std::vector<std::vector<double>> share_;  ///< layers x species
};

}  // namespace cupola
