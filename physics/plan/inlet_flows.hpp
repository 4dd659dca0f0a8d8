#pragma once
#include <optional>

#include "physics/plan/bed_pressure.hpp"
#include "schemas/campaign.hpp"

namespace cupola {

/// The campaign with the mass flow of every inlet: where one states its velocity or its pressure, what follows from the
/// pressure of the bed as `bed_pressure` estimates it.  A velocity is that of the ideal gas at the total temperature
/// less u^2/(2 cp); of pressures the mass flow is changed until the bed's is theirs.
/// @return nothing where no such flow is found: with a velocity the mass flow grows with the pressure, without limit
/// above some blast
std::optional<Campaign> with_mass_flows(const Campaign& campaign, const Charge& charge);

}  // namespace cupola
