#pragma once
#include <vector>

#include "physics/plan/plan.hpp"

namespace cupola {

/// Which physics the scene needs and why, for `explain`.
std::vector<PhysicsPiece> physics_pieces(const Campaign& campaign);

}  // namespace cupola
