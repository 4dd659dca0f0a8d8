#include "stage_dem/coupled_block.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>

namespace cupola {

double advance_with_gas(Engine& engine, SolidsOnMesh& solids, DemGas& gas, double step, long steps,
                        const std::function<void(double)>& seen) {
  using Clock = std::chrono::steady_clock;
  double seconds = 0;
  long left = steps;
  engine.advance(steps, [&] {
    const auto begun = Clock::now();
    const auto owned = engine.owned();
    solids.divide(owned);
    // The longest step that divides what is left of the block evenly.
    const auto parts = static_cast<long>(std::ceil(static_cast<double>(left) * step / gas.longest_step()));
    const long now = parts > 1 ? std::max(1L, left / parts) : left;
    gas.update(solids, owned, static_cast<double>(now) * step);
    engine.set_forces(gas.forces(solids, owned));
    if (seen) seen(static_cast<double>(now) * step);
    left -= now;
    seconds += std::chrono::duration<double>(Clock::now() - begun).count();
    return now;
  });
  return seconds;
}

}  // namespace cupola
