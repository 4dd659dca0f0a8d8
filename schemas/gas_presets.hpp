#pragma once
#include <string>
#include <vector>

#include "schemas/campaign.hpp"

namespace cupola {

/// Properties of a known gas.
struct GasPreset {
  std::string name;
  double molar_mass;       ///< kg/mol
  double heat_capacity;    ///< J/kg/K, at constant pressure
  double viscosity;        ///< Pa s
  double prandtl;          ///< 1
  Sutherland sutherland;   ///< viscosity over temperature
  JanafPolynomials janaf;  ///< heat capacity over temperature
};

/// `air` and `nitrogen`: at 300 K and 1 bar, Incropera & DeWitt, Fundamentals of Heat and Mass Transfer, table A.4.
/// `blast`: hot blast as in the hot blast furnace slot of Lichtenegger & Pirker: viscosity 2e-5 Pa s and Prandtl number
/// 0.8 of the paper, molar mass 28 g/mol and cv = 745 J/kg/K of its published case, so cp = cv + R/M; over the
/// temperature it is nitrogen.
/// Sutherland: White, Viscous Fluid Flow, table 1-2.  JANAF polynomials: McBride, Gordon and Reno, NASA TM-4513 (1993);
/// air as 78.08 % nitrogen, 20.95 % oxygen and 0.97 % argon by volume.
const std::vector<GasPreset>& gas_presets();

}  // namespace cupola
