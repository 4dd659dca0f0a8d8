#include "physics/closures/convection.hpp"

#include "physics/closures/gunn.hpp"
#include "physics/closures/ranz_marshall.hpp"
#include "physics/closures/wakao.hpp"

namespace cupola {

double heat_transfer_coefficient(const Heat& heat, const GasAround& gas, double diameter) {
  const double reynolds = gas.mass_flux * diameter / gas.viscosity;
  const auto nusselt = [&] {
    switch (heat.convection) {
      case Heat::Convection::gunn:
        return nusselt_gunn(reynolds, gas.prandtl, gas.void_fraction);
      case Heat::Convection::wakao:
        return nusselt_wakao(reynolds, gas.prandtl);
      case Heat::Convection::ranz_marshall:
        break;
    }
    return nusselt_ranz_marshall(reynolds, gas.prandtl);
  };
  return heat.nusselt_factor * nusselt() * gas.conductivity / diameter;
}

const char* convection_name(Heat::Convection law) {
  switch (law) {
    case Heat::Convection::gunn:
      return "gunn";
    case Heat::Convection::wakao:
      return "wakao";
    case Heat::Convection::ranz_marshall:
      break;
  }
  return "ranz-marshall";
}

}  // namespace cupola
