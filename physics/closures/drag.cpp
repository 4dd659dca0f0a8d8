#include "physics/closures/drag.hpp"

#include "physics/closures/drag_beetstra.hpp"
#include "physics/closures/drag_ergun.hpp"
#include "physics/closures/drag_gidaspow.hpp"

namespace cupola {

double drag_resistance(DragLaw law, double void_fraction, double grain_diameter, double viscosity, double density,
                       double superficial_speed, double polydispersity) {
  switch (law) {
    case DragLaw::ergun:
      return ergun_resistance(void_fraction, grain_diameter, viscosity, density, superficial_speed);
    case DragLaw::gidaspow:
      return gidaspow_resistance(void_fraction, grain_diameter, viscosity, density, superficial_speed);
    case DragLaw::beetstra:
      break;
  }
  return polydispersity * beetstra_resistance(void_fraction, grain_diameter, viscosity, density, superficial_speed);
}

double drag_exchange(DragLaw law, double void_fraction, double grain_diameter, double viscosity, double density,
                     double superficial_speed, double polydispersity) {
  return void_fraction * void_fraction *
         drag_resistance(law, void_fraction, grain_diameter, viscosity, density, superficial_speed, polydispersity);
}

const char* drag_law_name(DragLaw law) {
  switch (law) {
    case DragLaw::ergun:
      return "ergun";
    case DragLaw::gidaspow:
      return "gidaspow";
    case DragLaw::beetstra:
      break;
  }
  return "beetstra";
}

}  // namespace cupola
