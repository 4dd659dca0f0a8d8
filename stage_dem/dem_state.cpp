#include "stage_dem/dem_state.hpp"

namespace cupola {

std::string phase_name(DemPhase phase) {
  switch (phase) {
    case DemPhase::building:
      return "building";
    case DemPhase::settling:
      return "settling";
    case DemPhase::regrowing:
      return "regrowing";
    case DemPhase::relaxing:
      return "relaxing";
    case DemPhase::averaging:
      return "averaging";
    case DemPhase::done:
      break;
  }
  return "done";
}

}  // namespace cupola
