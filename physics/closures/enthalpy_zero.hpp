#pragma once

namespace cupola {

/// Temperature that enthalpies of gas and solids count from, K.
inline constexpr double enthalpy_zero = 293;

}  // namespace cupola
