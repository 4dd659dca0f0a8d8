#include "stage_tracer/predictor/first_guess.hpp"

#include <algorithm>

#include "physics/plan/heat_balance.hpp"
#include "schemas/failure.hpp"

namespace cupola {
namespace {

double interpolate(const std::vector<double>& at, const std::vector<double>& values, double x) {
  const auto above = std::upper_bound(at.begin(), at.end(), x);
  if (above == at.begin()) return values.front();
  if (above == at.end()) return values.back();
  const auto i = static_cast<std::size_t>(above - at.begin());
  const double share = (x - at[i - 1]) / (at[i] - at[i - 1]);
  return values[i - 1] + share * (values[i] - values[i - 1]);
}

}  // namespace

BedTemperatures guess_from_plan(const BedMesh& mesh, const Campaign& campaign, const Charge& charge) {
  const std::optional<HeatBalance> balance = heat_balance(campaign, charge);
  if (!balance) {
    throw Failure(ExitCode::wrong_input,
                  "a prediction needs heat, gas and a bed that descends; this campaign lacks one of them");
  }
  const CounterCurrentSolution& profile = balance->profile;
  const std::size_t cells = mesh.cells();
  BedTemperatures guess{std::vector<double>(cells), BySpecies(campaign.species.size(), std::vector<double>(cells))};
  for (std::size_t c = 0; c < cells; ++c) {
    const double depth = campaign.charging.stock_line - mesh.cell_centre[c][2];
    guess.gas[c] = interpolate(profile.depth, profile.gas_temperature, depth);
    for (std::vector<double>& solids : guess.solids) solids[c] = guess.gas[c];
    for (std::size_t k = 0; k < balance->kinds.size(); ++k)
      guess.solids[balance->kinds[k]][c] = interpolate(profile.depth, profile.solids_temperature[k], depth);
  }
  return guess;
}

}  // namespace cupola
