#pragma once
#include <cmath>

namespace cupola {

/// log(1 + z)/z, 1 at z = 0; z > -1.
inline double log1p_over(double z) {
  if (std::abs(z) < 1e-3) return 1 - z * (1.0 / 2 - z * (1.0 / 3 - z * (1.0 / 4 - z * (1.0 / 5 - z / 6))));
  return std::log1p(z) / z;
}

/// (exp(z) - 1)/z, 1 at z = 0.
inline double expm1_over(double z) {
  if (std::abs(z) < 1e-3) return 1 + z * (1.0 / 2 + z * (1.0 / 6 + z * (1.0 / 24 + z * (1.0 / 120 + z / 720))));
  return std::expm1(z) / z;
}

/// (exp(z) - 1 - z)/z^2, 1/2 at z = 0.
inline double expm1_less_linear_over_square(double z) {
  if (std::abs(z) < 0.03) {
    double sum = 0;
    double factor = 1.0 / 2;
    for (int k = 3; k < 11; ++k) {
      sum += factor;
      factor *= z / k;
    }
    return sum;
  }
  return (std::expm1(z) - z) / (z * z);
}

}  // namespace cupola
