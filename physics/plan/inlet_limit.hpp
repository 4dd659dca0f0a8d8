#pragma once
#include <string>

#include "physics/closures/inlet.hpp"
#include "schemas/campaign.hpp"

namespace cupola {

/// Why an inlet cannot blow what is asked of it: a sentence with the smallest opening that works, where the gas chokes
/// or exceeds the Mach number that the gas models bear (MODEL 13); empty where it can.
/// @param state of the gas in the opening
std::string inlet_refusal(const Gas& gas, const Inlet& inlet, const InletState& state);

}  // namespace cupola
