#pragma once
#include "schemas/campaign.hpp"

namespace cupola {

/// The gas around a grain.
struct GasAround {
  double mass_flux = 0;      ///< |G|, kg/m2/s, superficial
  double viscosity = 0;      ///< Pa s
  double prandtl = 0;        ///< 1
  double conductivity = 0;   ///< W/m/K
  double void_fraction = 0;  ///< 1
};

/// Heat transfer coefficient between a grain and the gas by the campaign's law, `nusselt_factor` x Nu k/d, W/m2/K.  The
/// laws are in ranz_marshall.hpp, gunn.hpp and wakao.hpp.
/// @param diameter of the grain (not of the parcel), m
double heat_transfer_coefficient(const Heat& heat, const GasAround& gas, double diameter);

/// Name of a law as the campaign file spells it.
const char* convection_name(Heat::Convection law);

}  // namespace cupola
