#pragma once
#include <cmath>
#include <limits>

#include "physics/motion/exponentials.hpp"

namespace cupola {

/// A species' stay in one cell: dT/dt = rate (felt - T) + source, while a share exp(-removal t) of it is left.  All in
/// closed form, also for rates that vanish.
struct StayOfSolids {
  double entering;  ///< K
  double rate;      ///< 1/s
  double slope;     ///< K/s at the beginning: rate (felt - entering) + source
  double removal;   ///< 1/s

  StayOfSolids(double entering_temperature, double exchange_rate, double felt, double source, double removal_rate)
      : entering(entering_temperature),
        rate(exchange_rate),
        slope(exchange_rate * (felt - entering_temperature) + source),
        removal(removal_rate) {}

  /// (1 - exp(-x t))/x, t for x = 0.
  static double survived(double x, double t) { return t * expm1_over(-x * t); }

  [[nodiscard]] double temperature(double t) const { return entering + slope * survived(rate, t); }

  /// Integral of exp(-removal t) over the stay, s.
  [[nodiscard]] double volume_time(double t) const { return survived(removal, t); }

  /// Integral of (T - entering) exp(-removal t), K s.
  [[nodiscard]] double excess_time(double t) const {
    if (rate * t > 1e-5) return slope / rate * (survived(removal, t) - survived(removal + rate, t));
    // Integral of t exp(-removal t), the limit of no exchange.
    const double z = removal * t;
    const double moment = z < 1e-3 ? 0.5 - z / 3 + z * z / 8 : (-std::expm1(-z) / z - std::exp(-z)) / z;
    return slope * t * t * moment;
  }

  /// When a temperature above the entering one is reached; infinite where it never is.
  [[nodiscard]] double time_of(double wanted) const {
    const double rise = wanted - entering;
    if (rise <= 0) return 0;
    if (!(slope > 0)) return std::numeric_limits<double>::infinity();
    const double z = rate * rise / slope;
    return z < 1 ? rise / slope * log1p_over(-z) : std::numeric_limits<double>::infinity();
  }
};

}  // namespace cupola
