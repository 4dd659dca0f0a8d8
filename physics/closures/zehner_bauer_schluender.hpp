#pragma once

namespace cupola {

/// What conducts in a bed, for `bed_conductivity_zehner_bauer_schluender`.
struct BedConductors {
  double solid_conductivity = 0;  ///< k_p, W/m/K
  double gas_conductivity = 0;    ///< k_f, W/m/K, > 0
  double diameter = 0;            ///< d of the grains, m
  double emissivity = 0;          ///< 0 to 1; 0: no radiation
  double temperature = 0;         ///< K
};

/// Part of a grain's section that touches a neighbour, 1: ceramic spheres (VDI Heat Atlas, D6.3).
inline constexpr double contact_flattening = 0.0077;

/// Conductivity of a bed of spheres with gas and radiation between them, after Zehner, Bauer and Schluender (VDI Heat
/// Atlas, chapter D6.3; primary path of Zehner and Schluender 1970, radiation of Damkoehler, contacts of Bauer and
/// Schluender 1978), at normal pressure.  With K = k_p/k_f, K_r = 4 sigma T^3 d/((2/emissivity - 1) k_f), e the void
/// fraction, B = 1.25 ((1 - e)/e)^(10/9), N = 1 + (K_r - B)/K:
///   k/k_f = (1 - sqrt(1-e)) (1 + e K_r) + sqrt(1-e) (f K + (1-f) K_c),
///   K_c = 2/N (B (K + K_r - 1)/(N^2 K) ln((K + K_r)/B) + (B + 1)/(2B) (K_r - B) - (B - 1)/N).
/// Range: packed beds, e from 0.2 to 0.6; used up to 1 (gas alone), and below 0.05 as at 0.05.
/// @return W/m/K, per area of bed
double bed_conductivity_zehner_bauer_schluender(const BedConductors& bed, double void_fraction,
                                                double flattening = contact_flattening);

}  // namespace cupola
