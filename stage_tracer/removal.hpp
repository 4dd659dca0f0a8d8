#pragma once
#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "physics/closures/solid_enthalpy.hpp"
#include "schemas/campaign.hpp"

namespace cupola {

/// Why a tracer leaves the bed.
enum class Cause : std::uint8_t { raceway, melted, unmelted, lost };
inline constexpr std::size_t causes = 4;

/// Mass and enthalpy (from 293 K) that have left or entered, by cause, and tracers counted.
struct Tally {
  std::array<double, causes> mass{};      ///< kg
  std::array<double, causes> enthalpy{};  ///< J
  std::array<double, causes> tracers{};
  double charged_mass = 0;
  double charged_enthalpy = 0;
  double charged_tracers = 0;

  void leave(Cause cause, double leaving_mass, double leaving_enthalpy) {
    const auto c = static_cast<std::size_t>(cause);
    mass[c] += leaving_mass;
    enthalpy[c] += leaving_enthalpy;
    tracers[c] += 1;
  }
  void enter(double entering_mass, double entering_enthalpy) {
    charged_mass += entering_mass;
    charged_enthalpy += entering_enthalpy;
    charged_tracers += 1;
  }
  [[nodiscard]] double of(const std::array<double, causes>& values, Cause cause) const {
    return values[static_cast<std::size_t>(cause)];
  }

  /// As a flat row, for sums over ranks and checkpoints.
  static constexpr std::size_t columns = 3 * causes + 3;
  [[nodiscard]] std::vector<double> row() const;
  static Tally from_row(const std::vector<double>& row);
  Tally& operator+=(const Tally& other);
};

/// Enthalpy of a tracer from 293 K (MODEL 19), J.
inline double enthalpy(const Species& species, double volume, double temperature) {
  return volume * species.density * solid_enthalpy(species, temperature);
}

}  // namespace cupola
