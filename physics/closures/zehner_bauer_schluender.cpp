#include "physics/closures/zehner_bauer_schluender.hpp"

#include <algorithm>
#include <cmath>

namespace cupola {
namespace {

constexpr double stefan_boltzmann = 5.670374419e-8;  // W/m2/K4

/// K_c of the unit cell's core.
double core(double solid, double radiation, double shape) {
  // Where K + K_r = B, N is 0 and the formula 0/0, smooth though: its mean from both sides.
  const double vanishing = 1 + (radiation - shape) / solid;
  if (std::abs(vanishing) < 1e-3)
    return (core(solid * (1 + 4e-3), radiation, shape) + core(solid * (1 - 4e-3), radiation, shape)) / 2;
  return 2 / vanishing *
         (shape * (solid + radiation - 1) / (vanishing * vanishing * solid) * std::log((solid + radiation) / shape) +
          (shape + 1) / (2 * shape) * (radiation - shape) - (shape - 1) / vanishing);
}

}  // namespace

double bed_conductivity_zehner_bauer_schluender(const BedConductors& bed, double void_fraction, double flattening) {
  const double e = std::clamp(void_fraction, 0.05, 1.0);
  if (e == 1) return bed.gas_conductivity;
  const double solid = bed.solid_conductivity / bed.gas_conductivity;
  const double exchange = bed.emissivity > 0 ? 1 / (2 / bed.emissivity - 1) : 0;
  const double radiation = 4 * stefan_boltzmann * exchange * bed.temperature * bed.temperature * bed.temperature *
                           bed.diameter / bed.gas_conductivity;
  const double shape = 1.25 * std::pow((1 - e) / e, 10. / 9.);
  const double root = std::sqrt(1 - e);
  return bed.gas_conductivity * ((1 - root) * (1 + e * radiation) +
                                 root * (flattening * solid + (1 - flattening) * core(solid, radiation, shape)));
}

}  // namespace cupola
