#pragma once
#include <cmath>

namespace cupola {

/// log(1 + z)/z, 1 at z = 0; z > -1.
inline double log1p_over(double z) {
  if (std::abs(z) < 1e-3) return 1 - z * (1.0 / 2 - z * (1.0 / 3 - z * (1.0 / 4 - z * (1.0 / 5 - z / 6))));
  return std::log1p(z) / z;
}

/// (exp(z) - 1 - z)/z^2, 1/2 at z = 0.  The series as far as it is exact to round-off: paths that stay in a cell seldom
/// leave its range, and need no call of the library.
inline double expm1_less_linear_over_square(double z) {
  if (std::abs(z) > 0.1) return (std::expm1(z) - z) / (z * z);
  constexpr double c2 = 1.0 / 2;
  constexpr double c3 = c2 / 3;
  constexpr double c4 = c3 / 4;
  constexpr double c5 = c4 / 5;
  constexpr double c6 = c5 / 6;
  constexpr double c7 = c6 / 7;
  constexpr double c8 = c7 / 8;
  constexpr double c9 = c8 / 9;
  constexpr double c10 = c9 / 10;
  constexpr double c11 = c10 / 11;
  // In two halves, which the processor works out side by side.
  const double square = z * z;
  const double even = c2 + square * (c4 + square * (c6 + square * (c8 + square * c10)));
  const double odd = c3 + square * (c5 + square * (c7 + square * (c9 + square * c11)));
  return even + z * odd;
}

/// (exp(z) - 1)/z, 1 at z = 0.
inline double expm1_over(double z) {
  return std::abs(z) > 0.1 ? std::expm1(z) / z : 1 + z * expm1_less_linear_over_square(z);
}

}  // namespace cupola
