#pragma once
#include <array>
#include <cstdint>
#include <vector>

#include "physics/gas/gas_thermodynamics.hpp"
#include "physics/mesh/bed_mesh.hpp"

namespace cupola {

/// The discrete energy balance of a cell's gas, upwind:
///   sum_inflows m (h(T) - h(T_from)) + sum_sides k (T - T_beside) + c T = s,
/// all arrays over all cells.  Rising in T, so that no temperature leaves the range of what surrounds it.
struct EnergyBalance {
  struct Side {
    std::int64_t beside = -1;  ///< cell; -1: nothing there
    double inflow = 0;         ///< kg/s that come from it, >= 0
    double conduction = 0;     ///< W/K
  };
  std::vector<std::array<Side, 6>> sides;
  std::vector<double> given_inflow;    ///< kg/s from the inlets
  std::vector<double> given_enthalpy;  ///< W, with it, from 293 K
  std::vector<double> conductance;     ///< c, W/K: solids and walls
  std::vector<double> source;          ///< s, W: the same x temperature
};

/// What is out of balance in each cell, W: the right minus the left side.
std::vector<double> imbalance(const EnergyBalance& balance, const GasThermodynamics& gas,
                              const std::vector<double>& temperature);

/// Gauss-Seidel sweeps in the order given, each cell solved exactly.  In the order of falling pressure the gas of a
/// porous bed meets no loops, so that what it carries needs one sweep and only the conduction more.
/// @return sweeps made: until the sum of the imbalances is at most `tolerance`, or until they fall too slowly
int sweep(const EnergyBalance& balance, const GasThermodynamics& gas, const std::vector<std::int64_t>& order,
          double tolerance, std::vector<double>& temperature, double& remaining);

}  // namespace cupola
