#pragma once
#include <filesystem>
#include <vector>

#include "orchestrator/report/stage_report.hpp"

namespace cupola {

/// `RUN/fields/*.xdmf`: the results of all episodes as time series that ParaView opens, one time step an episode; they
/// hold no numbers but name the HDF5 data of the results, relative to the run folder, so that it can be moved.  The
/// points' own numbers, which ParaView needs to draw them, are in `vertices.hdf` beside them.
///
///   `dem_fields.xdmf`, `tracer_fields.xdmf`   the mesh with its cell fields
///   `parcels.xdmf`, `tracers.xdmf`            points with their properties
///
/// A file that no finished stage has something for is not written.
/// @throws Failure input_output
void write_paraview_views(const std::filesystem::path& run_folder, const std::vector<StageReport>& stages);

}  // namespace cupola
