#pragma once
#include <string>

namespace cupola {

/// Core seconds that a piece of the work takes, once: what an estimate of the run time rests on.  The defaults are
/// those of docs/models.md; `orchestrator/measured_rates.hpp` takes them from the stages that this machine has run.
struct Rates {
  double contacts = 1 / 2.1e6;           ///< a parcel and a DEM step
  double dem_gas = 1e-5;                 ///< a cell and a gas solution of the DEM stage
  double motion = 3e-7;                  ///< a tracer and a step: motion, removal, charging
  double exchange = 5e-7;                ///< a cell and a step: heat between gas and solids, averages
  double conduction = 5e-7;              ///< a cell and a step: conduction within and between species
  double gas_flow = 8e-6;                ///< a cell and a solution of the flow in the tracer stage
  double gas_flow_navier_stokes = 2e-5;  ///< the same with the Navier-Stokes equations
  double gas_energy = 1e-6;              ///< a cell and a solution of the gas energy
  std::string basis = "built-in rates; nothing has been measured on this machine yet";
};

}  // namespace cupola
