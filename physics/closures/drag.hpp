#pragma once
#include "schemas/campaign.hpp"

namespace cupola {

/// Resistance of the bed to gas by the campaign's drag law: `-grad p = resistance x U`, U the superficial velocity
/// relative to the solids, the pressure gradient being that of the whole bed (paper eq. 8 without inertia).  The laws
/// are in drag_*.hpp; their Reynolds number is |G| d/mu with G = density x superficial speed.
/// @param void_fraction of the gas, floored by the caller, in (0, 1)
/// @param grain_diameter m, Sauter mean of the unsoftened grains (never of parcels)
/// @param viscosity Pa s  @param density of the gas, kg/m3  @param superficial_speed m/s
/// @param factor on the law: `BedState::drag_factor` of the cell (mixtures, coarse parcels and cells), 1 for none
/// @return kg/m3/s
double drag_resistance(DragLaw law, double void_fraction, double grain_diameter, double viscosity, double density,
                       double superficial_speed, double factor = 1);

/// Exchange coefficient beta: drag force per bed volume over the slip velocity (interstitial gas - solids), kg/m3/s, of
/// the form of the equations with `alpha_f grad p` in the gas momentum (paper eq. 8): beta = resistance x
/// void_fraction^2.
double drag_exchange(DragLaw law, double void_fraction, double grain_diameter, double viscosity, double density,
                     double superficial_speed, double factor = 1);

/// Name of a law as the campaign file spells it.
const char* drag_law_name(DragLaw law);

}  // namespace cupola
