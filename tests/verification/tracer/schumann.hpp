#pragma once
#include <cmath>
#include <vector>

namespace cupola::testing {

/// Schumann's packed bed (1929): gas enters at 1 a bed at 0, Y = h a z/(G c_g), Z = h a t/(rho_s c_s), no conduction:
///   T_s(Y, Z) = exp(-Y) integral_0^Z exp(-u) I0(2 sqrt(Y u)) du,  T_g = 1 - T_s(Z, Y)   (the anzelius-J symmetry),
/// by Gauss-Legendre on panels; relative accuracy better than 1e-10 for Y, Z up to some tens.
inline double schumann_solids(double y, double z) {
  constexpr int panels = 400;
  constexpr double node = 0.7745966692414834;  // three-point Gauss
  double sum = 0;
  for (int k = 0; k < panels; ++k) {
    const double middle = (k + 0.5) * z / panels;
    const double half = 0.5 * z / panels;
    for (const auto& [at, weight] : {std::pair{-node, 5.0 / 9}, std::pair{0.0, 8.0 / 9}, std::pair{node, 5.0 / 9}}) {
      const double u = middle + half * at;
      sum += half * weight * std::exp(-u - y) * std::cyl_bessel_i(0.0, 2 * std::sqrt(y * u));
    }
  }
  return sum;
}

inline double schumann_gas(double y, double z) { return 1 - schumann_solids(z, y); }

/// Values of equidistant samples x0 + k dx at x by a cubic through the four around it.
inline double interpolate(const std::vector<double>& values, double x0, double dx, double x) {
  const double place = (x - x0) / dx;
  const auto last = static_cast<double>(values.size()) - 4;
  const auto first = static_cast<std::size_t>(std::min(std::max(std::floor(place) - 1, 0.0), last));
  double sum = 0;
  for (std::size_t i = 0; i < 4; ++i) {
    double weight = 1;
    for (std::size_t j = 0; j < 4; ++j) {
      if (j == i) continue;
      weight *= (place - static_cast<double>(first + j)) / (static_cast<double>(i) - static_cast<double>(j));
    }
    sum += weight * values[first + i];
  }
  return sum;
}

}  // namespace cupola::testing
