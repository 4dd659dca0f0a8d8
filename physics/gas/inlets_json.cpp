#include "physics/gas/inlets_json.hpp"

namespace cupola {

nlohmann::json inlets_json(const std::vector<BedFlow::NamedInlet>& inlets) {
  nlohmann::json list = nlohmann::json::array();
  for (const BedFlow::NamedInlet& inlet : inlets)
    list.push_back({{"name", inlet.name},
                    {"pressure", inlet.state.static_pressure},
                    {"velocity", inlet.state.velocity},
                    {"mach", inlet.state.mach_number}});
  return list;
}

}  // namespace cupola
