#include <gtest/gtest.h>

#include <cmath>

#include "physics/closures/carson.hpp"
#include "physics/closures/convection.hpp"
#include "physics/closures/gas_properties.hpp"
#include "physics/closures/layer_exchange.hpp"
#include "physics/closures/ranz_marshall.hpp"
#include "physics/closures/syamlal_gidaspow.hpp"

namespace cupola {
namespace {

TEST(RanzMarshall, SingleGrainCoolingAsInTheReferenceCase) {
  const double d = 3.6e-3, rho = 8850, cp = 55.0, k = 0.051865, mu = 1.8603e-5, gas_cp = 999.06, gas_rho = 1.1854,
               u = 6;
  const double prandtl = mu * gas_cp / k;
  EXPECT_NEAR(nusselt_ranz_marshall(gas_rho * u * d / mu, prandtl), 17.811, 5e-4);
  const double h = heat_transfer_coefficient(Heat{1}, {gas_rho * u, mu, prandtl, k, 1}, d);
  const double tau = rho * cp * d / (6 * h);
  EXPECT_NEAR(tau, 1.1381, 1e-4);
  const auto temperature = [&](double t) { return 298.15 + 75 * std::exp(-t / tau); };
  EXPECT_NEAR(temperature(0.1), 366.8415, 1e-3);
  EXPECT_NEAR(temperature(0.5), 346.4858, 1e-3);
  EXPECT_NEAR(temperature(1.0), 329.3014, 1e-3);
}

TEST(RanzMarshall, StagnantGasGivesTwo) { EXPECT_DOUBLE_EQ(nusselt_ranz_marshall(0, 0.8), 2); }

TEST(RanzMarshall, TimeConstantsOfTheFurnace) {
  // 1500 K, 5 m/s, 1 bar, M 28, cv 745, mu 2e-5, Pr 0.8; densities of the paper and of the published case.
  const double mu = 2e-5, prandtl = 0.8, cp = 745 + molar_gas_constant / 0.028;
  const double flux = 5 * gas_density(1e5, 1500, 0.028);
  const double k = gas_conductivity(mu, cp, prandtl);
  const auto tau = [&](double rho, double heat_capacity, double d, double factor) {
    return rho * heat_capacity * d / (6 * heat_transfer_coefficient(Heat{factor}, {flux, mu, prandtl, k, 1}, d));
  };
  EXPECT_NEAR(tau(800, 850, 0.044, 1), 284, 0.5);
  EXPECT_NEAR(tau(3000, 600, 0.015, 1), 143, 0.5);
  EXPECT_NEAR(tau(950, 850, 0.044, 1), 337, 0.5);
  EXPECT_NEAR(tau(3300, 600, 0.015, 1), 157, 0.5);
  EXPECT_NEAR(tau(800, 850, 0.044, 0.1), 2840, 5);
}

TEST(Carson, BedOfThePaper) {
  EXPECT_NEAR(bed_conductivity_carson(80, 0.56), 27.2, 1e-12);
  EXPECT_NEAR(bed_conductivity_carson(1.7, 0.56), 0.578, 1e-12);
}

TEST(Carson, Limits) {
  EXPECT_EQ(bed_conductivity_carson(80, 0.2), 0);
  EXPECT_NEAR(bed_conductivity_carson(80, 1.0 / 3), 0, 1e-12);
  EXPECT_DOUBLE_EQ(bed_conductivity_carson(80, 1), 80);
  EXPECT_DOUBLE_EQ(bed_conductivity_carson(80, 1.3), 80);
  for (double a = 0; a < 1; a += 0.01) {
    EXPECT_LE(bed_conductivity_carson(80, a), bed_conductivity_carson(80, a + 0.01));
  }
}

TEST(SyamlalGidaspow, ProductInFrontOfTheGradient) {
  EXPECT_DOUBLE_EQ(gas_conductivity_syamlal_gidaspow(1, 0.026), 0.026);
  EXPECT_DOUBLE_EQ(gas_conductivity_syamlal_gidaspow(0, 0.026), 0);
  // e times the published (1 - sqrt(1-e))/e k_f at e = 0.44.
  EXPECT_NEAR(gas_conductivity_syamlal_gidaspow(0.44, 0.026), 0.44 * ((1 - std::sqrt(0.56)) / 0.44 * 0.026), 1e-16);
}

// The profile the formula was derived from, solved numerically: alternating layers, uniform sources of opposite sign,
// steady.
TEST(LayerExchange, EqualsTheResolvedProfileOfAlternatingLayers) {
  const double a = 0.825, b = 0.62, ka = 27.2, kb = 0.578;
  const double source = 100;           // W/m3 in layer a; taken out in layer b
  const double flux = source * a / 2;  // through each face of a
  const int n = 20000;
  // March from the middle of a to its face, then to the middle of b, with the local flux; mean temperatures by
  // midpoints.
  const auto mean_over_half = [&](double half, double k, double start, double flux_begin, double flux_end,
                                  double& end) {
    double t = start, sum = 0;
    const double h = half / n;
    for (int i = 0; i < n; ++i) {
      const double q = flux_begin + (flux_end - flux_begin) * (i + 0.5) / n;
      const double next = t - q / k * h;
      sum += (t + next) / 2 * h;
      t = next;
    }
    end = t;
    return sum / half;
  };
  double face = 0, middle = 0;
  const double mean_a = mean_over_half(a / 2, ka, 1000, 0, flux, face);
  const double mean_b = mean_over_half(b / 2, kb, face, flux, 0, middle);
  const double per_bed_volume = source * a / (a + b);
  EXPECT_NEAR(per_bed_volume / (mean_a - mean_b) / layer_exchange(a, ka, b, kb), 1, 1e-6);
}

TEST(LayerExchange, SymmetricAndZeroWithoutConduction) {
  EXPECT_DOUBLE_EQ(layer_exchange(0.4, 27, 0.3, 0.6), layer_exchange(0.3, 0.6, 0.4, 27));
  EXPECT_EQ(layer_exchange(0.4, 27, 0.3, 0), 0);
}

TEST(Gas, IdealGas) {
  // Molar volume at 273.15 K and 101325 Pa: 22.413 969 54e-3 m3/mol (CODATA).
  EXPECT_NEAR(0.028 / gas_density(101325, 273.15, 0.028), 22.41396954e-3, 1e-10);
  EXPECT_NEAR(gas_conductivity(2e-5, 1042, 0.8), 0.02605, 1e-12);
  EXPECT_NEAR(heat_capacity_ratio(3.5 * molar_gas_constant / 0.028, 0.028), 1.4, 1e-12);
}

}  // namespace
}  // namespace cupola
