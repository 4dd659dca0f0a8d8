#pragma once
#include <cmath>

#include "schemas/campaign.hpp"

namespace cupola {

/// Temperature of the solids in the campaign's guessed cohesive zone, an inverted V: `below` under z = tip - slope |x|,
/// `above` over it.
inline double guessed_temperature(const InvertedV& guess, const Vector3& position) {
  return position[2] < guess.tip - guess.slope * std::abs(position[0]) ? guess.below : guess.above;
}

}  // namespace cupola
