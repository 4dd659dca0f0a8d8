#include "schemas/campaign.hpp"

#include <algorithm>
#include <stdexcept>

namespace cupola {

std::size_t Campaign::species_index(const std::string& wanted) const {
  const auto found = std::find_if(species.begin(), species.end(), [&](const Species& s) { return s.name == wanted; });
  if (found == species.end()) throw std::out_of_range("no species named " + wanted);
  return static_cast<std::size_t>(found - species.begin());
}

double Campaign::half_width(double z) const {
  const auto& profile = scene.geometry.profile;
  if (z <= profile.front()[0]) return profile.front()[1];
  for (std::size_t i = 1; i < profile.size(); ++i) {
    const auto& [z0, w0] = profile[i - 1];
    const auto& [z1, w1] = profile[i];
    if (z <= z1) return w0 + (w1 - w0) * (z - z0) / (z1 - z0);
  }
  return profile.back()[1];
}

}  // namespace cupola
