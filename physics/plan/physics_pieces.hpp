#pragma once
#include <vector>

#include "physics/plan/plan.hpp"

namespace cupola {

/// Which physics the scene needs and why, for `explain`, with what each is expected to cost.
std::vector<PhysicsPiece> physics_pieces(const Campaign& campaign, const Cost::Parts& cost);

}  // namespace cupola
