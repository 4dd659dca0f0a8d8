#pragma once
#include <nlohmann/json.hpp>

#include "physics/gas/bed_gas.hpp"

namespace cupola {

/// `inlets[]{name, pressure (Pa), velocity (m/s), mach}` of a stage's summary (docs/contracts.md).
nlohmann::json inlets_json(const std::vector<BedFlow::NamedInlet>& inlets);

}  // namespace cupola
