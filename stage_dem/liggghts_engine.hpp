#pragma once
#include <mpi.h>

#include "stage_dem/engine.hpp"

namespace cupola {

/// LIGGGHTS soft spheres behind the engine interface: one instance on a duplicate of the communicator.
/// Its own log goes to `liggghts.log` in the folder.
/// @throws Failure diverged with LIGGGHTS' sentence where it refuses a command
std::unique_ptr<Engine> make_liggghts_engine(const Campaign& campaign, const EngineSetUp& set_up,
                                             MPI_Comm communicator);

}  // namespace cupola
