#pragma once
#include "physics/closures/gas_properties.hpp"
#include "schemas/campaign.hpp"

namespace cupola {

/// Heat capacity and enthalpy of an ideal gas from polynomials of the JANAF/NASA form (McBride, Gordon and Reno, NASA
/// TM-4513), per mole and the molar gas constant R:
///   cp/R = a0 + a1 T + a2 T^2 + a3 T^3 + a4 T^4,
///   h/R  = a0 T + a1/2 T^2 + a2/3 T^3 + a3/4 T^4 + a4/5 T^5 + a5,
/// one set of coefficients on each side of the common temperature.  Range: that of the polynomials; beyond its ends the
/// heat capacity stays what it is there.
class Janaf {
 public:
  explicit Janaf(const Gas& gas)
      : polynomials_(gas.janaf), specific_gas_constant_(molar_gas_constant / gas.molar_mass) {}

  /// At constant pressure, J/kg/K.
  [[nodiscard]] double heat_capacity(double temperature) const {
    return specific_gas_constant_ * capacity(held(temperature));
  }
  /// J/kg; only differences mean something.
  [[nodiscard]] double enthalpy(double temperature) const {
    const double inside = held(temperature);
    return specific_gas_constant_ * (integral(inside) + capacity(inside) * (temperature - inside));
  }

 private:
  [[nodiscard]] double held(double temperature) const {
    return temperature < polynomials_.from ? polynomials_.from
           : temperature > polynomials_.to ? polynomials_.to
                                           : temperature;
  }
  [[nodiscard]] const std::array<double, 7>& coefficients(double temperature) const {
    return temperature < polynomials_.common ? polynomials_.low : polynomials_.high;
  }
  [[nodiscard]] double capacity(double t) const {
    const auto& a = coefficients(t);
    return (((a[4] * t + a[3]) * t + a[2]) * t + a[1]) * t + a[0];
  }
  [[nodiscard]] double integral(double t) const {
    const auto& a = coefficients(t);
    return ((((a[4] / 5 * t + a[3] / 4) * t + a[2] / 3) * t + a[1] / 2) * t + a[0]) * t + a[5];
  }

  JanafPolynomials polynomials_;
  double specific_gas_constant_;
};

}  // namespace cupola
