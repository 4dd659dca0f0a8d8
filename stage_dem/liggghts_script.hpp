#pragma once
#include <string>
#include <vector>

#include "stage_dem/engine.hpp"

namespace cupola {

/// LIGGGHTS' type number of a species (from 1) and of the walls (the last).
inline int liggghts_type(std::size_t species) { return static_cast<int>(species) + 1; }

/// The commands that come before the box: units, boundaries, decomposition over `ranks`.
std::vector<std::string> liggghts_opening(const Campaign& campaign, int ranks);

/// The command that makes the box: the slot with its charging hopper and a margin.
std::vector<std::string> liggghts_box(const Campaign& campaign);

/// Contacts, walls, gravity, forces from the gas and integration; the same for a new and for a resumed run.
std::vector<std::string> liggghts_physics(const Campaign& campaign, const std::string& wall_file, double time_step);

/// Contact of two species, or of a species and the wall (`second` = number of species). @throws Failure wrong_input
ContactPair contact_pair(const Campaign& campaign, std::size_t first, std::size_t second);

/// Normal stiffness of a pair of parcels with linear springs (MODEL 7): the parcel's is n times the stated one, n its
/// coarse graining (1 where the stated one is the parcel's), two in series: 2 n_i n_j/(n_i + n_j) K; against a wall
/// n_i K, N/m.
double pair_stiffness(const Campaign& campaign, std::size_t first, std::size_t second);

/// Damping of a linear spring that gives the restitution e (seed 004 eq. 15): -2 m ln(e)/t, t = sqrt(pi^2 + ln^2 e)
/// sqrt(m/K), with the reduced mass m, kg/s.  e is taken within 0.001 … 1.
double pair_damping(double stiffness, double reduced_mass, double restitution);

}  // namespace cupola
