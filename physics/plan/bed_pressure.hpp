#pragma once
#include <optional>

#include "physics/plan/charge.hpp"
#include "physics/plan/heat_balance.hpp"
#include "schemas/campaign.hpp"

namespace cupola {

/// Pressure the gas needs to get through the bed, from the campaign's drag law along the height:
///   d(p^2/2)/ds = (R T/M) r G,  G = mass flow/area, layers of ore and coke one after the other.
/// Without heat the gas keeps the inlets' temperature.  The convergence of the flow in front of tuyeres is left out, so
/// that the pressure there is rather higher and the Mach number rather lower.
struct BedPressure {
  double at_inlets = 0;       ///< Pa
  double drop = 0;            ///< Pa, from the inlets to the stock line
  double weight_carried = 0;  ///< the drop over the bed's weight per area: 1 would lift it
  double most_carried = 0;    ///< the same locally, largest value
};

/// @returns nothing for a scene without gas or gas inlets
std::optional<BedPressure> bed_pressure(const Campaign& campaign, const Charge& charge,
                                        const std::optional<HeatBalance>& heat);

}  // namespace cupola
