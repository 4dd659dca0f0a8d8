#pragma once
#include "physics/plan/charge.hpp"
#include "schemas/campaign.hpp"
#include "stage_tracer/predictor/steady_heat.hpp"

namespace cupola {

/// Temperatures to begin with: those of the one-dimensional counter-current bed of the campaign (`cupola explain`), the
/// same at one height; above the stock line those of the stock line, below the inlets those of the inlets.
/// @throws Failure wrong_input: no heat, no gas
BedTemperatures guess_from_plan(const BedMesh& mesh, const Campaign& campaign, const Charge& charge);

}  // namespace cupola
