#pragma once
#include <map>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

namespace cupola {

/// What the DEM stage is doing.
enum class DemPhase {
  building,   ///< pouring the initial bed
  settling,   ///< no removal: the bed comes to rest; its speed at the end is the creep
  regrowing,  ///< parcels that have become colder with the new cohesive zone grow back
  relaxing,   ///< removal and charging, before the window
  averaging,  ///< the window
  done
};

/// As in progress.json and history.jsonl.
std::string phase_name(DemPhase phase);

/// The stage's own numbers, apart from those of its parts: all that a resumed run must know.
struct DemState {
  DemPhase phase = DemPhase::building;
  double time = 0;        ///< s of process, since the task began
  double phase_time = 0;  ///< s, since the phase began
  double last_block = 0;  ///< s, the block just done; 0: none yet
  std::int64_t next_id = 1;
  std::int64_t fast_parcels = 0;             ///< parcels faster than 5 m/s, added up over blocks after the building
  double largest_overlap = 0;                ///< over the smaller radius, after the building
  double largest_wall_overlap = 0;           ///< over the parcel's radius, after the building
  double relaxed_after = 0;                  ///< s, of relaxation
  std::vector<double> descent;               ///< m/s of each block of the present phase: mean speed downwards
  double creep_speed = 0;                    ///< m/s downwards, end of the settling
  double mean_speed = 0;                     ///< m/s, last block
  double stock_height = 0;                   ///< m
  double wall_before = 0;                    ///< s of wall time in earlier starts of this task
  std::map<std::string, double> wall_parts;  ///< s of wall time by part, over all starts
};

NLOHMANN_DEFINE_TYPE_NON_INTRUSIVE(DemState, phase, time, phase_time, last_block, next_id, fast_parcels,
                                   largest_overlap, largest_wall_overlap, relaxed_after, descent, creep_speed,
                                   mean_speed, stock_height, wall_before, wall_parts)

}  // namespace cupola
