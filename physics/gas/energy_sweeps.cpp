#include "physics/gas/energy_sweeps.hpp"

#include <cmath>

namespace cupola {
namespace {

/// Both sides of the balance of a cell, but for the enthalpy of its own temperature.
struct Gathered {
  double inflow = 0;       ///< kg/s
  double conductance = 0;  ///< W/K
  double right = 0;        ///< W
};

Gathered gather(const EnergyBalance& balance, std::int64_t cell, const std::vector<double>& temperature,
                const std::vector<double>& enthalpy) {
  Gathered sum{balance.given_inflow[cell], balance.conductance[cell],
               balance.source[cell] + balance.given_enthalpy[cell]};
  for (const auto& side : balance.sides[cell]) {
    if (side.beside < 0) continue;
    sum.inflow += side.inflow;
    sum.conductance += side.conduction;
    sum.right += side.inflow * enthalpy[side.beside] + side.conduction * temperature[side.beside];
  }
  return sum;
}

std::vector<double> enthalpies(const GasThermodynamics& gas, const std::vector<double>& temperature) {
  std::vector<double> enthalpy(temperature.size());
  for (std::size_t cell = 0; cell < temperature.size(); ++cell) enthalpy[cell] = gas.enthalpy(temperature[cell]);
  return enthalpy;
}

}  // namespace

std::vector<double> imbalance(const EnergyBalance& balance, const GasThermodynamics& gas,
                              const std::vector<double>& temperature) {
  const auto enthalpy = enthalpies(gas, temperature);
  std::vector<double> result(temperature.size());
  for (std::size_t cell = 0; cell < temperature.size(); ++cell) {
    const auto sum = gather(balance, static_cast<std::int64_t>(cell), temperature, enthalpy);
    result[cell] = sum.right - sum.inflow * enthalpy[cell] - sum.conductance * temperature[cell];
  }
  return result;
}

int sweep(const EnergyBalance& balance, const GasThermodynamics& gas, const std::vector<std::int64_t>& order,
          double tolerance, std::vector<double>& temperature, double& remaining) {
  constexpr int most_sweeps = 100;
  constexpr double slow = 0.5;  // of the imbalance left by a sweep
  auto enthalpy = enthalpies(gas, temperature);
  double before = 0;
  for (int sweeps = 1; sweeps <= most_sweeps; ++sweeps) {
    double met = 0;  // imbalances as they are met: those of the state before, upstream corrected
    for (const auto cell : order) {
      const auto sum = gather(balance, cell, temperature, enthalpy);
      double& here = temperature[cell];
      double excess = sum.right - sum.inflow * enthalpy[cell] - sum.conductance * here;
      met += std::abs(excess);
      // Exact at once where the heat capacity is constant; Newton's method, quadratic from close by, else.
      for (int iteration = 0; iteration < (gas.constant() ? 1 : 4); ++iteration) {
        here += excess / (sum.inflow * gas.heat_capacity(here) + sum.conductance);
        enthalpy[cell] = gas.enthalpy(here);
        excess = sum.right - sum.inflow * enthalpy[cell] - sum.conductance * here;
      }
    }
    remaining = met;
    if (!std::isfinite(met)) return sweeps;
    if (met <= tolerance || (sweeps > 6 && met > slow * before)) {
      remaining = 0;
      for (const double value : imbalance(balance, gas, temperature)) remaining += std::abs(value);
      if (remaining <= tolerance || met > tolerance) return sweeps;
    }
    before = met;
  }
  return most_sweeps;
}

}  // namespace cupola
