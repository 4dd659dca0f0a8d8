#pragma once

namespace cupola {

/// Warn above this Mach number in a tuyere; refuse above the other (docs/models.md).
inline constexpr double mach_to_warn = 0.3;
inline constexpr double mach_to_refuse = 0.8;

/// Gas in the opening of an inlet.
struct InletState {
  double velocity = 0;            ///< m/s
  double mach_number = 0;         ///< 1
  double static_temperature = 0;  ///< K
  double static_pressure = 0;     ///< Pa
  double total_pressure = 0;      ///< Pa, of the blast main without losses
  double density = 0;             ///< kg/m3
  [[nodiscard]] bool choked() const { return mach_number > 1; }
};

/// State of an ideal gas of constant heat capacity that leaves an opening against a static pressure, from the total
/// enthalpy:
///   T = T0/(1 + (g-1)/2 Ma^2),  mass flow = p A Ma sqrt(g M/(R T)),  g = cp/cv,
/// which is a quadratic in Ma^2.  Above Ma = 1 the opening chokes: the state then only says that the flow does not fit.
/// @param mass_flow kg/s, >= 0  @param total_temperature T0, K  @param opening m2  @param static_pressure Pa
/// @param molar_mass kg/mol  @param heat_capacity at constant pressure, J/kg/K
InletState inlet_state(double mass_flow, double total_temperature, double opening, double static_pressure,
                       double molar_mass, double heat_capacity);

/// Smallest opening that passes the flow at no more than `mach_number`, m2. Arguments as `inlet_state`.
double smallest_opening(double mass_flow, double total_temperature, double static_pressure, double molar_mass,
                        double heat_capacity, double mach_number = mach_to_refuse);

}  // namespace cupola
