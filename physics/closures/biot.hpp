#pragma once

namespace cupola {

/// Above this Biot number a grain is not at one temperature.
inline constexpr double biot_to_flag = 0.1;

/// Biot number h (V/A)/k of a sphere, V/A = d/6.
/// @param transfer h to the gas, W/m2/K  @param diameter of the grain, m  @param conductivity of the grain, W/m/K
inline double biot_number(double transfer, double diameter, double conductivity) {
  return transfer * diameter / (6 * conductivity);
}

/// Heat transfer coefficient between the gas and the mean temperature of a sphere, the resistance of its inside in
/// series with that of the gas (Stuke 1948, Jeffreson 1972; exact for the parabola of steady heating):
///   1/h' = 1/h + d/(10 k).
/// Range: heating that is slow against d^2 rho cp/(4 pi^2 k).  @return W/m2/K
inline double transfer_with_intragrain_resistance(double transfer, double diameter, double conductivity) {
  return transfer / (1 + transfer * diameter / (10 * conductivity));
}

}  // namespace cupola
