#pragma once
#include <string>
#include <vector>

namespace cupola {

/// Properties of a known gas, constant over temperature.
struct GasPreset {
  std::string name;
  double molar_mass;     ///< kg/mol
  double heat_capacity;  ///< J/kg/K, at constant pressure
  double viscosity;      ///< Pa s
  double prandtl;        ///< 1
};

/// `air` and `nitrogen`: at 300 K and 1 bar, Incropera & DeWitt, Fundamentals of Heat and Mass Transfer, table A.4.
/// `blast`: hot blast as in the hot blast furnace slot of Lichtenegger & Pirker: viscosity 2e-5 Pa s and Prandtl number
/// 0.8 of the paper, molar mass 28 g/mol and cv = 745 J/kg/K of its published case, so cp = cv + R/M.
const std::vector<GasPreset>& gas_presets();

}  // namespace cupola
