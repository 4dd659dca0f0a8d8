#pragma once
#include <array>
#include <cstdint>

namespace cupola {

/// What a random number is for: streams of different use never share a number.
enum class RandomUse : std::uint32_t { seeding = 1, life, entry_position, entry_phase, displacement };

/// Four independent uniform numbers in (0, 1) from the counter-based generator Philox 4x32-10 (Salmon et al. 2011), a
/// pure function of its arguments: the same on any number of ranks and after a restart.
std::array<double, 4> random_uniform(std::uint64_t seed, RandomUse use, std::uint64_t id, std::uint32_t step = 0);

}  // namespace cupola
