#pragma once

namespace cupola {

/// Heterogeneity index H_d = a (Re_p + b)^c of the energy-minimisation multi-scale (EMMS) drag of a coarse mesh: the
/// drag of clustered grains over that of evenly spread ones, with the fits a, b, c of the void fraction e of Schneider,
/// Eppinger and co-workers' "Fluidized Bed in Industry Scale" (seed 003), table of fits: five ranges of e from 0.4 to 1
/// and 1 below 0.4.
///
/// In the range 0.465 <= e < 0.61 the table as it has come down to us has a minus before 0.6252 in a and a plus before
/// 19.6031 in b.  With those signs the index is negative at 0.465 and jumps fivefold at 0.61; with both signs exchanged
/// a, b and c join their neighbours (0.61 against 0.58, 0.020 against 0.017).  So they are exchanged here.
///
/// Range: fitted to 36 um grains of 2500 kg/m3 in air in a riser (Re_p about 0.01 to 10); use for other grains is an
/// extrapolation.  Where a fit leaves Re_p + b negative (b as low as -0.02 near e = 0.99) a hundredth of Re_p stands in
/// for it, and the index is at most 1: clusters never raise the drag.
/// @param void_fraction e  @param particle_reynolds Re_p = rho |u_gas - u_solids| d/mu, with the slip velocity
double emms_heterogeneity_index(double void_fraction, double particle_reynolds);

/// Gidaspow's resistance times the index.  Units and arguments as `ergun_resistance`.
double emms_resistance(double void_fraction, double grain_diameter, double viscosity, double density,
                       double superficial_speed);

}  // namespace cupola
