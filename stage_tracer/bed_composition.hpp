#pragma once
#include <vector>

#include "physics/mesh/bed_mesh.hpp"
#include "stage_tracer/cell_contents.hpp"
#include "stage_tracer/granular_field.hpp"

namespace cupola {

/// Material volume of each species in each bed cell, as gas and conduction see it (MODEL 10): the packing (contact
/// volume fraction) comes from the DEM field, the shares and the softening from the tracers,
///   V_s = share_s alpha_contact f V_cell,  f = sum V / sum (V_s/f_eff,s(T_s)).
/// Cells that no tracer reaches hold the persistent species in the proportions of the charge and the DEM's own solids
/// fraction.
/// @param contents spread (`spread`)
BySpecies bed_composition(const BedMesh& mesh, const Campaign& campaign, const GranularField& field,
                          const CellContents& contents, const std::vector<double>& empty_share);

/// Proportions of the persistent species in the charge (of all species where none persists).
std::vector<double> share_of_persistent(const Campaign& campaign, const Charge& charge);

/// Part of each bed cell that is solid (material volume).
std::vector<double> solids_fraction(const BedMesh& mesh, const BySpecies& species_volume);

}  // namespace cupola
