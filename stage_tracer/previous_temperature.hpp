#pragma once
#include <optional>
#include <vector>

#include "physics/mesh/bed_mesh.hpp"
#include "schemas/task.hpp"
#include "stage_tracer/cell_contents.hpp"
#include "stage_tracer/tracers.hpp"

namespace cupola {

/// Temperatures at hand when the stage begins: the result of the previous tracer stage, or the campaign's guess; for
/// the tracers those of a prediction where there is one.
struct PreviousTemperature {
  std::vector<double> ore;       ///< K, all cells: what the DEM stage softened and melted by; empty without heat
  BySpecies by_species;          ///< K, [species][cell]; empty where there is no previous result
  std::optional<double> energy;  ///< J that the bed held at the end of the previous episode
};

/// @throws Failure wrong_input, input_output
PreviousTemperature read_previous_temperature(const std::filesystem::path& folder, const Task& task,
                                              const BedMesh& mesh);

/// Gives the tracers their temperatures: their own species' in their cell, or the guess at their position (without a
/// guess: the charge's).
void set_temperatures(Tracers& tracers, const PreviousTemperature& previous, const Campaign& campaign,
                      const PathField& paths);

}  // namespace cupola
