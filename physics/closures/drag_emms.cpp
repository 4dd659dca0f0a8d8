#include "physics/closures/drag_emms.hpp"

#include <algorithm>
#include <cmath>

#include "physics/closures/drag_gidaspow.hpp"

namespace cupola {
namespace {

struct Fit {
  double a, b, c;
};

/// 1/(1 + exp(-(e - centre)/width)), the step that the table's bell-shaped terms are made of.
double step(double e, double centre, double width) { return 1 / (1 + std::exp(-(e - centre) / width)); }

Fit fit(double e) {
  if (e < 0.4 || e >= 0.9997) return {1, 0, 0};
  if (e < 0.465) return {0.7008 - 0.5174 / (1 + std::pow(e / 0.437, 19.8051)), 0, 0};
  if (e < 0.61) {
    return {0.01786 + 0.6252 / (1 + std::pow(e / 0.5069, 32.3483)),
            19.5879 - 19.6031 * step(e, 0.4393, 0.00575) * (1 - step(e, 0.6701, 0.00999)),
            0.4036 - 0.4358 / (1 + std::pow(e / 0.5216, 21.1039))};
  }
  if (e < 0.9898) {
    return {1 / (61.9321 - 62.2738 * std::pow(e, 6.7883)),
            -0.2923 + 1.5321 * step(e, 0.9703, 0.2682) * (1 - step(e, 0.9703, 0.0322)),
            std::pow(0.00029 - 0.00029 * e, 0.1037)};
  }
  const double x = e - 0.9912;
  return {0.00657 + 1.9134 * step(e, 0.9966, 0.00399) * (1 - step(e, 0.9999, 0.00057)),
          x / (0.05377 - 15.9492 * x + 1444.8906 * x * x),
          13.08817 - 13.01786 * std::exp(-0.5 * std::pow((e - 0.9975) / 0.0533, 2))};
}

}  // namespace

double emms_heterogeneity_index(double void_fraction, double particle_reynolds) {
  const Fit found = fit(void_fraction);
  if (found.c == 0) return std::min(1.0, found.a);
  const double base = std::max(particle_reynolds + found.b, 0.01 * particle_reynolds);
  return std::min(1.0, found.a * std::pow(std::max(base, 0.0), found.c));
}

double emms_resistance(double void_fraction, double grain_diameter, double viscosity, double density,
                       double superficial_speed) {
  const double reynolds = density * superficial_speed / void_fraction * grain_diameter / viscosity;
  return emms_heterogeneity_index(void_fraction, reynolds) *
         gidaspow_resistance(void_fraction, grain_diameter, viscosity, density, superficial_speed);
}

}  // namespace cupola
