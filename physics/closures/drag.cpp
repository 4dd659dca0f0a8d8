#include "physics/closures/drag.hpp"

#include "physics/closures/drag_beetstra.hpp"
#include "physics/closures/drag_di_felice.hpp"
#include "physics/closures/drag_emms.hpp"
#include "physics/closures/drag_ergun.hpp"
#include "physics/closures/drag_gidaspow.hpp"
#include "physics/closures/drag_koch_hill.hpp"

namespace cupola {
namespace {

double law_resistance(DragLaw law, double void_fraction, double grain_diameter, double viscosity, double density,
                      double superficial_speed) {
  switch (law) {
    case DragLaw::ergun:
      return ergun_resistance(void_fraction, grain_diameter, viscosity, density, superficial_speed);
    case DragLaw::wen_yu:
      return wen_yu_resistance(void_fraction, grain_diameter, viscosity, density, superficial_speed);
    case DragLaw::gidaspow:
      return gidaspow_resistance(void_fraction, grain_diameter, viscosity, density, superficial_speed);
    case DragLaw::di_felice:
      return di_felice_resistance(void_fraction, grain_diameter, viscosity, density, superficial_speed);
    case DragLaw::koch_hill:
      return koch_hill_resistance(void_fraction, grain_diameter, viscosity, density, superficial_speed);
    case DragLaw::emms:
      return emms_resistance(void_fraction, grain_diameter, viscosity, density, superficial_speed);
    case DragLaw::beetstra:
      break;
  }
  return beetstra_resistance(void_fraction, grain_diameter, viscosity, density, superficial_speed);
}

}  // namespace

double drag_resistance(DragLaw law, double void_fraction, double grain_diameter, double viscosity, double density,
                       double superficial_speed, double factor) {
  return factor * law_resistance(law, void_fraction, grain_diameter, viscosity, density, superficial_speed);
}

double drag_exchange(DragLaw law, double void_fraction, double grain_diameter, double viscosity, double density,
                     double superficial_speed, double factor) {
  return void_fraction * void_fraction *
         drag_resistance(law, void_fraction, grain_diameter, viscosity, density, superficial_speed, factor);
}

const char* drag_law_name(DragLaw law) {
  switch (law) {
    case DragLaw::ergun:
      return "ergun";
    case DragLaw::wen_yu:
      return "wen-yu";
    case DragLaw::gidaspow:
      return "gidaspow";
    case DragLaw::di_felice:
      return "di-felice";
    case DragLaw::koch_hill:
      return "koch-hill";
    case DragLaw::emms:
      return "emms";
    case DragLaw::beetstra:
      break;
  }
  return "beetstra";
}

}  // namespace cupola
