#pragma once
#include <filesystem>

#include "schemas/task.hpp"

namespace cupola::bench {

/// What the tracer stage is timed with.
struct TracerBench {
  std::filesystem::path campaign;  ///< campaign file
  double cell_factor = 1;          ///< cells along each edge over the campaign's
  double tracers_per_cell = 1;
  double seconds = 600;  ///< process time
  int ranks = 1;
  bool reference = false;  ///< short steps, the flow solved to tight residuals in every step
  double time_step = 0;    ///< s; 0: auto, or the reference's
};

/// The reference's step, s.
inline constexpr double reference_step = 0.25;

/// Makes a task folder for `cupola-tracer`, mesh and all.  No DEM stage has run: the bed is generated (layers of the
/// recipe on lattices at the expected packing, ore above the guessed zone only, a descending flux that follows the
/// walls to the raceways; tests/support/settled_bed.hpp).  Nothing is done where the folder holds this task already.
/// @param tracer path of the program `cupola-tracer`
void make_tracer_task(const std::filesystem::path& folder, const TracerBench& bench,
                      const std::filesystem::path& tracer);

}  // namespace cupola::bench
