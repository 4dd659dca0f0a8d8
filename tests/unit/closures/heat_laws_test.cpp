#include <gtest/gtest.h>

#include <cmath>

#include "physics/closures/biot.hpp"
#include "physics/closures/convection.hpp"
#include "physics/closures/gas_state.hpp"
#include "physics/closures/gunn.hpp"
#include "physics/closures/solid_enthalpy.hpp"
#include "physics/closures/wakao.hpp"
#include "physics/closures/zehner_bauer_schluender.hpp"
#include "schemas/gas_presets.hpp"

namespace cupola {
namespace {

Gas preset(const std::string& name) {
  for (const auto& one : gas_presets()) {
    if (one.name != name) continue;
    Gas gas;
    gas.molar_mass = one.molar_mass;
    gas.heat_capacity = one.heat_capacity;
    gas.viscosity = one.viscosity;
    gas.prandtl = one.prandtl;
    gas.sutherland = one.sutherland;
    gas.janaf = one.janaf;
    gas.viscosity_model = Gas::ViscosityModel::sutherland;
    gas.heat_capacity_model = Gas::HeatCapacityModel::janaf;
    return gas;
  }
  throw std::logic_error("no such gas");
}

TEST(Gunn, FormulaAndLimits) {
  EXPECT_NEAR(nusselt_gunn(100, 0.7, 0.4), 22.267, 1e-3);
  EXPECT_DOUBLE_EQ(nusselt_gunn(0, 0.7, 1), 2);  // a single sphere in gas at rest
  EXPECT_DOUBLE_EQ(nusselt_gunn(0, 0.7, 0.4), 3.8);
  EXPECT_GT(nusselt_gunn(100, 0.7, 0.4), nusselt_gunn(100, 0.7, 0.8));
}

TEST(Wakao, FormulaAndLimits) {
  EXPECT_NEAR(nusselt_wakao(1000, 0.7), 63.6253, 1e-4);
  EXPECT_DOUBLE_EQ(nusselt_wakao(0, 0.7), 2);
}

TEST(Convection, FactorScalesEveryLaw) {
  const GasAround gas{1.5, 4e-5, 0.7, 0.06, 0.42};
  for (const auto law : {Heat::Convection::ranz_marshall, Heat::Convection::gunn, Heat::Convection::wakao}) {
    Heat heat;
    heat.convection = law;
    const double whole = heat_transfer_coefficient(heat, gas, 0.03);
    heat.nusselt_factor = 0.1;
    EXPECT_DOUBLE_EQ(heat_transfer_coefficient(heat, gas, 0.03), 0.1 * whole) << convection_name(law);
  }
}

/// The primary path by its definition: heat flows in parallel lines through the core of solid and gas, whose surface is
/// r^2 + z^2/(B - (B - 1) z)^2 = 1.
double primary_path(double ratio, double shape) {
  constexpr int parts = 100000;
  double sum = 0;
  for (int i = 0; i < parts; ++i) {
    const double z = (i + 0.5) / parts;
    sum += 2 * z * shape / (std::pow(shape - (shape - 1) * z, 3) * (1 - z * (1 - 1 / ratio)));
  }
  return sum / parts;
}

TEST(ZehnerBauerSchluender, WithoutRadiationIsTheIntegralOverItsUnitCell) {
  for (const double e : {0.3, 0.4, 0.5}) {
    const double shape = 1.25 * std::pow((1 - e) / e, 10. / 9.), root = std::sqrt(1 - e);
    for (const double ratio : {1.0, 1.5, 2.0, 10.0, 100.0, 1000.0}) {
      const double expected = 0.03 * (1 - root + root * primary_path(ratio, shape));
      EXPECT_NEAR(bed_conductivity_zehner_bauer_schluender({0.03 * ratio, 0.03, 0.01, 0, 300}, e, 0), expected,
                  1e-5 * expected)
          << e << " " << ratio;
    }
  }
}

TEST(ZehnerBauerSchluender, Limits) {
  // All of one conductivity: the bed has it too. No solids: the gas.
  EXPECT_NEAR(bed_conductivity_zehner_bauer_schluender({0.03, 0.03, 0.01, 0, 300}, 0.4), 0.03, 1e-12);
  EXPECT_DOUBLE_EQ(bed_conductivity_zehner_bauer_schluender({80, 0.03, 0.01, 0.8, 300}, 1), 0.03);
  // The published curve of a void fraction of 0.4: 3.64, 8.89 and 15.47 times the gas at ratios of 10, 100 and 1000.
  for (const auto& [ratio, expected] : {std::pair{10.0, 3.643}, {100.0, 8.887}, {1000.0, 15.467}})
    EXPECT_NEAR(bed_conductivity_zehner_bauer_schluender({ratio, 1, 0.01, 0, 300}, 0.4, 0), expected, 1e-3);
  // Where the formula is 0/0 it stays smooth.
  const double shape = 1.25 * std::pow(0.6 / 0.4, 10. / 9.);
  const auto at = [&](double ratio) {
    return bed_conductivity_zehner_bauer_schluender({ratio, 1, 0.01, 0, 300}, 0.4, 0);
  };
  EXPECT_NEAR(at(shape), (at(shape * 0.99) + at(shape * 1.01)) / 2, 1e-4);
}

TEST(ZehnerBauerSchluender, RadiationCountsWhereItIsHotAndGrainsAreLarge) {
  const auto bed = [](double diameter, double temperature, double emissivity) {
    return bed_conductivity_zehner_bauer_schluender({1.7, 0.1, diameter, emissivity, temperature}, 0.44);
  };
  EXPECT_LT(bed(0.044, 300, 0.8), 1.5 * bed(0.044, 300, 0));
  EXPECT_GT(bed(0.044, 1800, 0.8), 3 * bed(0.044, 1800, 0));
  EXPECT_GT(bed(0.044, 1800, 0.8), bed(0.015, 1800, 0.8));
  EXPECT_GT(bed(0.044, 1800, 0.9), bed(0.044, 1800, 0.5));
}

TEST(Sutherland, AirAndNitrogenOfTheTables) {
  // Incropera and DeWitt, table A.4, Pa s.
  const Gas air = preset("air"), nitrogen = preset("nitrogen");
  EXPECT_NEAR(gas_viscosity(air, 300), 184.6e-7, 0.005 * 184.6e-7);
  EXPECT_NEAR(gas_viscosity(air, 1000), 424.4e-7, 0.025 * 424.4e-7);
  EXPECT_NEAR(gas_viscosity(nitrogen, 300), 178.2e-7, 0.005 * 178.2e-7);
  EXPECT_NEAR(gas_viscosity(nitrogen, 1000), 399.9e-7, 0.005 * 399.9e-7);
  EXPECT_DOUBLE_EQ(gas_viscosity(air, air.sutherland.at), air.sutherland.viscosity);
}

TEST(JanafGas, NitrogenOfTheTables) {
  // NIST-JANAF thermochemical tables: J/mol/K, and kJ/mol from 298.15 K.
  const Gas nitrogen = preset("nitrogen");
  const GasState gas(nitrogen);
  for (const auto& [temperature, capacity, enthalpy] :
       {std::array{1000.0, 32.697, 21.463}, {2000.0, 35.971, 56.137}, {2500.0, 36.616, 74.305}}) {
    EXPECT_NEAR(gas.heat_capacity(temperature) * nitrogen.molar_mass, capacity, 3e-3 * capacity);
    const double rise = gas.enthalpy(temperature) - gas.enthalpy(298.15);
    EXPECT_NEAR(rise * nitrogen.molar_mass / 1e3, enthalpy, 1.5e-3 * enthalpy);
  }
  EXPECT_NEAR(GasState(preset("air")).heat_capacity(1000), 1141, 3);  // Incropera and DeWitt, table A.4
}

TEST(JanafGas, EnthalpyIsTheIntegralOfTheHeatCapacity) {
  const GasState gas(preset("air"));
  EXPECT_NEAR(gas.enthalpy(293), 0, 1e-6);
  for (const double t : {150.0, 250.0, 700.0, 1500.0, 2600.0, 7000.0}) {
    const double slope = (gas.enthalpy(t + 0.1) - gas.enthalpy(t - 0.1)) / 0.2;
    EXPECT_NEAR(slope, gas.heat_capacity(t), 1e-5 * slope) << t;
  }
  // The two ranges meet.
  EXPECT_NEAR(gas.enthalpy(1000 + 1e-6), gas.enthalpy(1000 - 1e-6), 5);
}

TEST(Biot, ResistanceInsideIsInSeries) {
  // A sphere heated evenly: the mean is below the surface by q d/(10 k).
  const double h = 120, d = 0.044, k = 1.7;
  EXPECT_DOUBLE_EQ(1 / transfer_with_intragrain_resistance(h, d, k), 1 / h + d / (10 * k));
  EXPECT_NEAR(transfer_with_intragrain_resistance(h, d, 1e9), h, 1e-6);
  EXPECT_DOUBLE_EQ(biot_number(h, d, k), h * d / 6 / k);
}

Species ore() {
  Species species;
  species.heat_capacity = 600;
  species.softening = Softening{1475, 1675, 250e3};
  return species;
}

TEST(SolidEnthalpy, LatentHeatIsTakenUpBetweenSofteningAndMelting) {
  const Species species = ore();
  EXPECT_DOUBLE_EQ(solid_enthalpy(species, 293), 0);
  EXPECT_DOUBLE_EQ(solid_enthalpy(species, 1475), 600 * 1182.0);
  EXPECT_DOUBLE_EQ(solid_enthalpy(species, 1575), 600 * 1282.0 + 125e3);
  EXPECT_DOUBLE_EQ(solid_enthalpy(species, 1675), 600 * 1382.0 + 250e3);
  EXPECT_DOUBLE_EQ(apparent_heat_capacity(species, 1574), 600 + 250e3 / 200);
  EXPECT_DOUBLE_EQ(apparent_heat_capacity(species, 1474), 600);
}

TEST(SolidEnthalpy, TemperatureIsItsInverse) {
  Species species = ore();
  for (const bool table : {false, true}) {
    if (table) species.heat_capacity = PropertyCurve({{300, 500}, {900, 1100}, {1000, 700}, {2000, 800}});
    for (double t = 200; t < 2500; t += 7.3)
      EXPECT_NEAR(solid_temperature(species, solid_enthalpy(species, t)), t, 1e-9) << t;
  }
}

}  // namespace
}  // namespace cupola
