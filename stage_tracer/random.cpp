#include "stage_tracer/random.hpp"

#include <Random123/philox.h>

namespace cupola {

std::array<double, 4> random_uniform(std::uint64_t seed, RandomUse use, std::uint64_t id, std::uint32_t step) {
  using Generator = r123::Philox4x32;
  const Generator::ctr_type counter = {
      {static_cast<std::uint32_t>(id), static_cast<std::uint32_t>(id >> 32U), step, static_cast<std::uint32_t>(use)}};
  const Generator::key_type key = {{static_cast<std::uint32_t>(seed), static_cast<std::uint32_t>(seed >> 32U)}};
  const auto word = Generator()(counter, key);
  constexpr double scale = 1.0 / 4294967296.0;
  return {(word[0] + 0.5) * scale, (word[1] + 0.5) * scale, (word[2] + 0.5) * scale, (word[3] + 0.5) * scale};
}

}  // namespace cupola
