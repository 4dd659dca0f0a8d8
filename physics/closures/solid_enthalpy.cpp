#include "physics/closures/solid_enthalpy.hpp"

#include <algorithm>
#include <cmath>

namespace cupola {

double solid_enthalpy(const Species& species, double temperature) {
  double enthalpy = species.heat_capacity.integral(enthalpy_zero, temperature);
  if (species.softening && species.softening->latent_heat > 0) {
    const Softening& softening = *species.softening;
    enthalpy += softening.latent_heat *
                std::clamp((temperature - softening.from) / (softening.melted - softening.from), 0.0, 1.0);
  }
  return enthalpy;
}

double apparent_heat_capacity(const Species& species, double temperature) {
  double capacity = species.heat_capacity.at(temperature);
  if (species.softening && species.softening->latent_heat > 0) {
    const Softening& softening = *species.softening;
    if (temperature >= softening.from && temperature < softening.melted)
      capacity += softening.latent_heat / (softening.melted - softening.from);
  }
  return capacity;
}

double solid_temperature(const Species& species, double enthalpy) {
  if (has_constant_heat_capacity(species)) return enthalpy_zero + enthalpy / species.heat_capacity.at(enthalpy_zero);
  // The enthalpy rises with the temperature everywhere, at least with the smallest and at most with the largest of the
  // heat capacities: Newton's method inside a bracket.
  double least = species.heat_capacity.points().front()[1];
  for (const auto& point : species.heat_capacity.points()) least = std::min(least, point[1]);
  const double furthest = std::abs(enthalpy) / least;
  double low = enthalpy_zero - furthest - 1, high = enthalpy_zero + furthest + 1;
  double temperature = enthalpy_zero + enthalpy / species.heat_capacity.at(enthalpy_zero);
  for (int iteration = 0; iteration < 200; ++iteration) {
    const double excess = solid_enthalpy(species, temperature) - enthalpy;
    if (excess == 0) return temperature;
    (excess > 0 ? high : low) = temperature;
    double next = temperature - excess / apparent_heat_capacity(species, temperature);
    if (!(next > low && next < high)) next = (low + high) / 2;
    // Two neighbouring numbers: nothing lies between.
    if (std::abs(next - temperature) <= 4e-16 * std::abs(temperature)) return next;
    temperature = next;
  }
  return temperature;
}

}  // namespace cupola
