#pragma once
#include <memory>

#include "schemas/campaign.hpp"

namespace cupola {

/// Heat capacity and enthalpy of the campaign's gas for the gas energy: constant, or JANAF polynomials evaluated by
/// OpenFOAM's thermophysical library (janafThermo of a perfect gas).  Beyond the range of the polynomials the heat
/// capacity stays what it is at the end.  (`Janaf` in physics/closures says the same for programs without OpenFOAM.)
class GasThermodynamics {
 public:
  explicit GasThermodynamics(const Gas& gas);
  ~GasThermodynamics();

  [[nodiscard]] bool constant() const { return thermo_ == nullptr; }
  [[nodiscard]] double heat_capacity(double temperature) const;  ///< at constant pressure, J/kg/K
  [[nodiscard]] double enthalpy(double temperature) const;       ///< J/kg from 293 K

 private:
  struct Thermo;
  [[nodiscard]] double absolute_enthalpy(double temperature) const;

  double constant_heat_capacity_;
  double from_, to_;
  std::unique_ptr<Thermo> thermo_;  ///< null for a constant heat capacity
  double zero_ = 0;                 ///< J/kg, at 293 K
};

}  // namespace cupola
